// SPDX-License-Identifier: Apache-2.0
#include "eval/report/report.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "eval/report/axis.h"
#include "eval/report/charts.h"
#include "eval/report/style.h"
#include "eval/report/tables.h"
#include "eval/report/words.h"
#include "limber/clip/clip.h"
#include "tests/support/markup.h"

namespace limber::eval {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

TEST(Words, MarkupInTextIsEscaped) {
  EXPECT_EQ(escaped("a<b>&\"c'"), "a&lt;b&gt;&amp;&quot;c&#39;");
  EXPECT_EQ(escaped("h\xc3\xb6he"), "h\xc3\xb6he");
}

TEST(Words, BytesThatAreNoTextAreReplaced) {
  for (const std::string bytes : {"\xff", "\xc3", "\xed\xa0\x80", "\xc0\xaf", "\x01", "\xf4\x90\x80\x80"}) {
    const std::string text = escaped("a" + bytes + "b");
    EXPECT_THAT(text, HasSubstr("a\xef\xbf\xbd"));
    EXPECT_EQ(text.back(), 'b');
  }
}

TEST(Words, NumbersHaveSignificantDigits) {
  EXPECT_EQ(number(0.058472), "0.0585");
  EXPECT_EQ(number(94.22), "94.2");
  EXPECT_EQ(number(9.996), "10.0");
  EXPECT_EQ(number(999.96), "1,000");
  EXPECT_EQ(number(16843, 5), "16,843");
  EXPECT_EQ(number(3.7e-7),
            "3.70\xc3\x97"
            "10\xe2\x81\xbb\xe2\x81\xb7");
  EXPECT_EQ(number(0.0), "0");
  EXPECT_EQ(number(-1.5),
            "\xe2\x88\x92"
            "1.50");
  EXPECT_EQ(number(kNothing), number(std::optional<double>()));
}

TEST(Words, CountsAndBytesHaveUnits) {
  EXPECT_EQ(count(0), "0");
  EXPECT_EQ(count(999), "999");
  EXPECT_EQ(count(1234567), "1,234,567");
  EXPECT_EQ(byte_count(812), "812 B");
  EXPECT_EQ(byte_count(103400), "103 KB");
}

TEST(Words, Base64IsThatOfTheStandard) {
  const auto of = [](std::string_view text) { return base64(std::as_bytes(std::span(text.data(), text.size()))); };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
}

TEST(Axis, TicksAreRoundAndEncloseTheValues) {
  const Axis axis = linear_axis(0, 0.137);
  EXPECT_EQ(axis.low, 0);
  EXPECT_GE(axis.high, 0.137);
  EXPECT_DOUBLE_EQ(axis.ticks.back(), axis.high);
  EXPECT_EQ(tick_label(axis, axis.ticks[1]), "0.05");
  EXPECT_EQ(tick_label(axis, axis.ticks[2]), "0.10");
}

TEST(Axis, ValuesThatAreNoneGiveAnAxisAllTheSame) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Axis& axis : {linear_axis(0, -infinity), linear_axis(2, 2), logarithmic_axis(infinity, -infinity),
                           logarithmic_axis(0, 0), logarithmic_axis(3, 3), share_axis(0)}) {
    EXPECT_LT(axis.low, axis.high);
    EXPECT_GE(axis.ticks.size(), 2u);
    EXPECT_GE(axis.place(axis.ticks.front()), 0);
    EXPECT_LE(axis.place(axis.ticks.back()), 1);
  }
}

TEST(Axis, OneFrameHasOneTick) {
  const Axis axis = frame_axis(7, 7);
  EXPECT_THAT(axis.ticks, ElementsAre(7));
  EXPECT_EQ(axis.place(7), 0.5);
}

TEST(Axis, FramesAreCountedInWholeNumbers) {
  for (const double tick : frame_axis(1, 4, 8).ticks) EXPECT_EQ(tick, std::round(tick));
}

TEST(Axis, ALogarithmicOneHasEqualStepsForEqualRatios) {
  const Axis axis = logarithmic_axis(0.8, 90);
  EXPECT_LE(axis.low, 0.8);
  EXPECT_GE(axis.high, 90);
  EXPECT_NEAR(axis.place(10) - axis.place(1), axis.place(100) - axis.place(10), 1e-12);
}

TEST(SpreadLabels, StayInOrderAndApartAndWithinTheirRoom) {
  const std::vector<double> places = spread_labels({50, 52, 51, 0, 99}, 15, 4, 96);
  std::vector<double> sorted = places;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i) EXPECT_GE(sorted[i] - sorted[i - 1], 15 - 1e-9);
  EXPECT_GE(sorted.front(), 4);
  EXPECT_LE(sorted.back(), 96);
  EXPECT_LT(places[0], places[2]);
  EXPECT_LT(places[2], places[1]);
}

TEST(SpreadLabels, ThatHaveRoomStayWhereTheyAre) {
  EXPECT_THAT(spread_labels({80, 20}, 15, 0, 100), ElementsAre(80, 20));
  EXPECT_TRUE(spread_labels({}, 15, 0, 100).empty());
}

TEST(SpreadLabels, ThatHaveNoRoomAreSetCloser) {
  const std::vector<double> places = spread_labels(std::vector<double>(11, 5), 15, 0, 100);
  EXPECT_DOUBLE_EQ(places.front(), 0);
  EXPECT_DOUBLE_EQ(places.back(), 100);
}

TEST(FrameChart, AGapLeavesAHoleInTheLine) {
  const FrameChart chart{
      .name = "a", .y_title = "b", .first_frame = 1, .series = {{"m<1>", MethodMark{0}, {1, kNothing, 2, 3}}}};
  const std::string svg = draw_frame_chart(chart, Room::kWide);
  EXPECT_EQ(test::markup_fault(svg), "");
  EXPECT_THAT(svg, HasSubstr("m&lt;1&gt;"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(FrameChart, NothingAndOneFrameAreDrawnToo) {
  for (const std::vector<double>& values : {std::vector<double>{}, {0.0}, {0.2}, {kNothing}}) {
    for (const bool logarithmic : {false, true}) {
      const FrameChart chart{
          .name = "a", .y_title = "b", .logarithmic = logarithmic, .series = {{"m", MethodMark{9}, values}}};
      for (const Room room : {Room::kWide, Room::kNarrow}) {
        const std::string svg = draw_frame_chart(chart, room);
        EXPECT_EQ(test::markup_fault(svg), "");
        EXPECT_THAT(svg, Not(HasSubstr("nan")));
        EXPECT_THAT(svg, Not(HasSubstr("inf")));
      }
    }
  }
}

TEST(FrameChart, AVeryLongClipStaysSmall) {
  FrameChart chart{.name = "a", .y_title = "b", .series = {{"m", MethodMark{0}, std::vector<double>(100'000, 1.0)}}};
  EXPECT_LT(draw_frame_chart(chart, Room::kWide).size(), 100'000u);
}

TEST(FrameChart, WhatIsAboveTheTopIsCutOffWhereTheLineLeaves) {
  const FrameChart chart{
      .name = "a",
      .y_title = "b",
      .low = 0,
      .top = 1,
      .series = {{"stays", MethodMark{0}, {0.5, 0.5}}, {"goes", MethodMark{1}, {0.0, 2.0, 0.0, 2.0}}}};
  const std::string svg = draw_frame_chart(chart, Room::kNarrow);
  EXPECT_EQ(test::markup_fault(svg), "");
  // Up to the top, halfway between the frames, twice, and down from it once: at y = 26.
  std::size_t at_top = 0;
  for (std::size_t at = svg.find(" 26.0"); at != std::string::npos; at = svg.find(" 26.0", at + 1)) ++at_top;
  EXPECT_GE(at_top, 3u);
  EXPECT_THAT(svg, Not(HasSubstr(" -")));
  const std::string wide = draw_frame_chart(chart, Room::kWide);
  EXPECT_THAT(wide, HasSubstr(">stays</text>"));
  EXPECT_THAT(wide, Not(HasSubstr(">goes</text>")));
}

TEST(SweepChart, ValuesAreItsTicksAndThoseFarApartAreSpread) {
  const auto chart = [](std::vector<SweepChart::Point> points) {
    return draw_sweep_chart({.name = "a", .x_title = "b", .y_title = "c", .used = 0.9, .points = std::move(points)});
  };
  const std::string linear = chart({{0.5, 1}, {0.9, 2}, {1, kNothing}});
  EXPECT_EQ(test::markup_fault(linear), "");
  for (const char* const tick : {">0.5<", ">0.9<", ">1.0<", "class=\"marked\""}) EXPECT_THAT(linear, HasSubstr(tick));
  EXPECT_THAT(linear, Not(HasSubstr("nan")));
  // A tenth of the way by value, and half of it by ratio.
  EXPECT_THAT(chart({{1, 1}, {10, 2}, {100, 3}}), HasSubstr("<path class=\"tick\" d=\"M175.0 "));
  for (const std::string& svg : {chart({}), chart({{3, 0}}), chart({{0, 1}, {0, 1}})})
    EXPECT_EQ(test::markup_fault(svg), "");
}

TEST(Standalone, ADrawingIsAFileWithItsStyle) {
  const std::string drawing = open_svg(100, 50, "a<b>") + "<path d=\"M0 0\"/></svg>\n";
  const std::string file = standalone(side_by_side(std::vector(6, drawing), 100, 50, "six"));
  EXPECT_EQ(test::markup_fault(file), "");
  EXPECT_TRUE(file.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 492 152\""));
  EXPECT_THAT(file, HasSubstr("translate(120 70)"));
  EXPECT_THAT(file, HasSubstr("prefers-color-scheme: dark"));
}

TEST(TradeOff, WhatIsNotFiniteIsLeftOut) {
  const double infinity = std::numeric_limits<double>::infinity();
  const TradeOff chart{.name = "a",
                       .x_title = "b",
                       .y_title = "c",
                       .points = {{"kept", MethodMark{0}, 0.5, 1.2}, {"lost", MethodMark{1}, 0, infinity}}};
  const std::string svg = draw_trade_off(chart, Room::kWide);
  EXPECT_EQ(test::markup_fault(svg), "");
  EXPECT_THAT(svg, HasSubstr("kept"));
  EXPECT_THAT(svg, Not(HasSubstr("lost")));
}

TEST(ErrorDistribution, SharesAddUpAndPercentilesAreThose) {
  ErrorDistribution distribution;
  for (int i = 0; i < 1000; ++i) distribution.add(0.001 * i);
  const std::vector<double> shares = distribution.shares(0.5, 10);
  double sum = 0;
  for (const double share : shares) sum += share;
  EXPECT_NEAR(sum, 1, 1e-9);
  EXPECT_NEAR(shares[3], 0.05, 0.005);
  EXPECT_NEAR(shares[10], 0.5, 0.01);
  EXPECT_NEAR(distribution.percentile(0.95), 0.95, 0.02);
}

TEST(ErrorDistribution, WithoutDistancesHasNoShares) {
  EXPECT_EQ(ErrorDistribution().percentile(0.5), 0);
  EXPECT_THAT(ErrorDistribution().shares(1, 2), ElementsAre(0, 0, 0));
}

TEST(WorstPlaces, FindsTheCornerThatIsMissing) {
  // A square of two triangles, and the same with a corner lifted in the second frame.
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 2, 3}};
  const std::vector<Vec3f> flat = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  std::vector<Vec3f> lifted = flat;
  lifted[1].z = 0.2f;
  const Surface original{triangles, flat};
  WorstPlaces places(2, 2000, 1);
  const Surface same[] = {original, original};
  places.add(original, same);
  const Surface other[] = {original, {triangles, lifted}};
  EXPECT_THAT(places.add(original, other), ElementsAre(1));
  EXPECT_EQ(places.of(1).frame, 1u);
  EXPECT_GT(places.of(1).point.x, 0.8);
  EXPECT_LT(places.of(1).point.y, 0.2);
  EXPECT_NEAR(places.of(1).normal.z, 1, 1e-6);
  EXPECT_LT(places.of(1).rms[0], 1e-5);
  EXPECT_GT(places.of(1).rms[1], 5);
  EXPECT_THAT(chosen_places(places, 2, 4), ElementsAre(1));
}

TEST(Parts, FollowTheSurfaceAndCountWhatLiesNearest) {
  // A square of two triangles that moves away; of one approximation both are left, of the other one, off by a tenth.
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 2, 3}};
  std::vector<Vec3f> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  Parts parts({{"corner", {0.7, 0.3, 0}, 0.1}, {"all", {0.5, 0.5, 0}, 1}}, 2, 1);
  const std::vector<Triangle> half = {{0, 1, 2}};
  for (int frame = 0; frame < 2; ++frame) {
    std::vector<Vec3f> lifted = square;
    for (Vec3f& p : lifted) p.z += 0.1f;
    const Surface approximations[] = {{triangles, square}, {half, lifted}};
    ASSERT_TRUE(parts.add({triangles, square}, approximations));
    for (Vec3f& p : square) p.x += 5;
  }
  EXPECT_THAT(parts.triangles(0), ElementsAre(0));
  EXPECT_THAT(parts.triangles(1), ElementsAre(0, 1));
  EXPECT_EQ(parts.measure(0, 0).triangles, 1);
  EXPECT_EQ(parts.measure(1, 0).triangles, 2);
  EXPECT_EQ(parts.measure(1, 1).last_triangles, 1);
  EXPECT_LT(parts.measure(1, 0).rms, 1e-4);
  EXPECT_NEAR(parts.measure(0, 1).rms, 10 / std::sqrt(2.0), 1e-3);
}

TEST(Parts, ABallBesideTheSurfaceIsRefused) {
  const std::vector<Triangle> triangles = {{0, 1, 2}};
  const std::vector<Vec3f> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Surface surface{triangles, positions};
  Parts parts({{"tail", {9, 9, 9}, 1}}, 1, 1);
  const Result<void> added = parts.add(surface, std::span(&surface, 1));
  ASSERT_FALSE(added);
  EXPECT_THAT(added.error().line(), HasSubstr("tail"));
}

// The parts of a page of the methods named, of a clip of so many frames.
struct Made {
  Comparison comparison;
  WorstPlaces places;
  KeptFrames kept;
  Mesh mesh;
};

std::unique_ptr<Made> make(const std::vector<const MethodInfo*>& methods, const char* clip, std::size_t frame_count) {
  std::unique_ptr<Made> made(
      new Made{Comparison(methods, {.vertices = 60}, {.distance = {.samples = {.per_triangle = 0, .at_least = 500}}}),
               WorstPlaces(methods.size(), 300, 1), KeptFrames(frame_count), Mesh{}});
  const auto reader = open_clip(clip, {});
  made->mesh = (*reader)->mesh();
  made->comparison.begin(made->mesh, *SeenFrames::read(**reader, methods, 2, [](std::uint32_t) { return true; }));
  std::vector<Vec3f> positions(made->mesh.vertex_count);
  while (*(*reader)->read(positions)) {
    EXPECT_TRUE(made->comparison.add(positions));
    std::vector<Surface> surfaces;
    for (const Contender& c : made->comparison.contenders())
      surfaces.push_back({c.approximation.triangles, c.approximation.positions});
    const std::vector<std::size_t> worse = made->places.add({made->mesh.triangles, positions}, surfaces);
    made->kept.add(positions, made->comparison, worse);
  }
  return made;
}

Report report_of(const Made& made, PictureSet pictures) {
  return {
      .comparison = made.comparison,
      .places = made.places,
      .clip = {.name = "a<b>", .vertex_count = made.mesh.vertex_count, .triangle_count = made.mesh.triangles.size()},
      .run = {.asked = "at most 60 vertices", .commands = {"limber compare 'a<b>'"}, .version = "1"},
      .storage = storage_rows(made.mesh, made.comparison, nullptr),
      .stream = {},
      .pictures = std::move(pictures)};
}

TEST(ReportPage, IsWholeForOneFrameAndOneMethod) {
  const auto made = make({find_method("direct")}, "sample:gallop?vertices=400&frames=1", 1);
  const auto pictures = take_report_pictures(made->mesh, made->kept, made->places, chosen_places(made->places, 1, 4),
                                             {}, [](std::size_t, std::size_t) { return true; });
  ASSERT_TRUE(pictures);
  EXPECT_EQ(pictures->gallery.size(), 1u);
  EXPECT_EQ(pictures->close_ups.size(), 1u);
  const std::string page = report_page(report_of(*made, *pictures));
  EXPECT_EQ(test::markup_fault(page), "");
  EXPECT_THAT(page, HasSubstr("a&lt;b&gt;"));
  EXPECT_THAT(page, Not(HasSubstr("a<b>")));
  EXPECT_THAT(page, Not(HasSubstr(">nan")));
}

TEST(ReportPage, ShowsSweepsAndHasThemInItsJson) {
  const MethodInfo* const methods[] = {find_method("direct"), find_method("first-frame")};
  const auto made = make({methods[0], methods[1]}, "sample:gallop?vertices=400&frames=3", 3);
  const auto alone = make({methods[1]}, "sample:gallop?vertices=400&frames=3", 3);
  const auto pictures = take_report_pictures(made->mesh, made->kept, made->places, {},
                                             {.sheet_labels = {"original", "direct", "first-frame"}},
                                             [](std::size_t, std::size_t) { return true; });
  ASSERT_TRUE(pictures);
  Report report = report_of(*made, *pictures);
  const SweepPoint point = sweep_point(0.5, alone->comparison, made->comparison);
  EXPECT_NEAR(point.relative, made->comparison.relative(1).rms_by_frame, 1e-12);
  EXPECT_FALSE(point.choice_bytes);
  report.sweeps = {{.parameter = "k<1>", .method = methods[1], .mark = {1}, .used = 0.5, .points = {point, point}}};
  report.sweeps.front().points.back().value = 0.7;
  const std::string page = report_page(report);
  EXPECT_EQ(test::markup_fault(page), "");
  EXPECT_THAT(page, HasSubstr("<section id=\"sweeps\">"));
  EXPECT_THAT(page, HasSubstr("k&lt;1&gt;"));
  const auto json = report_json(report);
  EXPECT_EQ(json["sweeps"][0]["points"][1]["value"], 0.7);
  EXPECT_EQ(json["sweeps"][0]["points"][0]["relative_rms"], point.relative);
  EXPECT_TRUE(json["parts"].empty());

  std::vector<std::string> names;
  for (const ReportFigure& figure : report_figures(report)) {
    names.push_back(figure.name);
    if (figure.name.ends_with(".svg")) {
      EXPECT_EQ(test::markup_fault(figure.bytes), "") << figure.name;
    } else {
      EXPECT_THAT(figure.bytes, testing::StartsWith("\x89PNG")) << figure.name;
    }
  }
  for (const char* const name :
       {"rms.svg", "trade-off.svg", "adapt-time.svg", "histograms.svg", "sweep-k-1-.svg", "frame-0002.png"})
    EXPECT_THAT(names, testing::Contains(name));
}

TEST(ReportPage, TakingPicturesStopsWhenAsked) {
  const auto made = make({find_method("direct")}, "sample:gallop?vertices=400&frames=1", 1);
  const auto pictures = take_report_pictures(made->mesh, made->kept, made->places, {}, {},
                                             [](std::size_t done, std::size_t) { return done < 2; });
  ASSERT_FALSE(pictures);
  EXPECT_EQ(pictures.error().code, ErrorCode::kCancelled);
}

TEST(KeptFrames, AreTheEndsTheWorstAndSomeBetween) {
  const auto made = make({find_method("direct"), find_method("first-frame")}, "sample:gallop?vertices=400&frames=9", 9);
  const std::vector<KeptFrames::Kept> kept = made->kept.gallery();
  ASSERT_LE(kept.size(), 5u);
  EXPECT_EQ(kept.front()->frame, 0u);
  EXPECT_EQ(kept.back()->frame, 8u);
  const auto frames = made->comparison.contenders().front().measure.frames();
  const auto worst = std::ranges::max_element(frames, {}, [](const FrameMeasure& f) { return f.distance.rms; });
  EXPECT_TRUE(std::ranges::any_of(kept, [&](const auto& k) { return k->frame == worst->number; }));
  EXPECT_EQ(made->kept.worst_of(1)->frame, made->places.of(1).frame);
}

TEST(StorageRows, ListTrianglesOnceWhereTheyNeverChange) {
  const auto made = make({find_method("direct"), find_method("first-frame")}, "sample:gallop?vertices=400&frames=3", 3);
  const std::vector<StorageRow> rows = storage_rows(made->mesh, made->comparison, nullptr);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].total,
            12.0 * static_cast<double>(made->mesh.triangles.size()) + 3 * 12.0 * made->mesh.vertex_count);
  EXPECT_NEAR(*rows[1].connectivity, 3 * *rows[2].connectivity, 0.1 * *rows[1].connectivity);
}

}  // namespace
}  // namespace limber::eval
