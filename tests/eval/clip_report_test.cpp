// SPDX-License-Identifier: Apache-2.0
#include "eval/clip_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/eval/shapes.h"

namespace limber::eval {
namespace {

using test::Shape;

ClipMeasure measure_frames(int frame_count) {
  ClipMeasure measure({.distance = {.samples = {.per_triangle = 1, .at_least = 2000}}, .first_frame_number = 3});
  const Shape original = test::square(4);
  for (int t = 0; t < frame_count; ++t) {
    const Shape approximation = test::square(1, static_cast<float>(t) / 8);
    measure.add(original, approximation, approximation.triangles);
  }
  return measure;
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) all.push_back(line);
  return all;
}

TEST(ReportJson, HasTheSchemaTheMeansAndEveryFrame) {
  const ClipMeasure measure = measure_frames(3);
  const nlohmann::ordered_json report = report_json(measure);
  EXPECT_EQ(report["schema"], "limber.measure/1");
  EXPECT_EQ(report["frame_count"], 3);
  const ClipSummary summary = measure.summary();
  EXPECT_EQ(report["rms"], summary.rms.mean);
  EXPECT_EQ(report["mean"], summary.mean.mean);
  EXPECT_EQ(report["max"], summary.max.mean);
  EXPECT_EQ(report["flicker"], summary.flicker->mean);
  EXPECT_EQ(report["changed"], 0.0);
  EXPECT_EQ(report["worst"]["rms"], summary.rms.worst);
  EXPECT_EQ(report["percentile_95"]["max"], summary.max.percentile_95);
  ASSERT_EQ(report["frames"].size(), 3u);
  EXPECT_EQ(report["frames"][0]["frame"], 3);
  EXPECT_TRUE(report["frames"][0]["flicker"].is_null());
  EXPECT_EQ(report["frames"][2]["flicker"], *measure.frames()[2].flicker);
  EXPECT_EQ(report["frames"][2]["to_original"]["samples"], 2000);
}

TEST(ReportJson, HasNullForWhatOneFrameCannotHave) {
  const nlohmann::ordered_json report = report_json(measure_frames(1));
  EXPECT_TRUE(report["flicker"].is_null());
  EXPECT_TRUE(report["worst"]["changed"].is_null());
  EXPECT_EQ(nlohmann::ordered_json::parse(report.dump()), report);
}

TEST(ReportTable, HasALinePerFrameOfEqualWidthAndASummary) {
  const std::vector<std::string> table = lines(report_table(measure_frames(3)));
  ASSERT_EQ(table.size(), 6u);
  for (const std::string& line : table) EXPECT_EQ(line.size(), table[0].size()) << line;
  EXPECT_THAT(table[0], testing::HasSubstr("rms"));
  EXPECT_THAT(table[1], testing::HasSubstr(" - "));
  EXPECT_THAT(table[4], testing::HasSubstr("mean"));
  EXPECT_THAT(table[5], testing::HasSubstr("17.67767")) << "a quarter of the side, in percent of the diagonal";
}

TEST(ReportJson, SaysHowItWasSampledAndHowSureItIs) {
  const Shape fine = test::sphere(20), coarse = test::sphere(5);
  ClipMeasure measure(
      {.distance = {.samples = {.per_triangle = 1, .at_least = 3000, .seed = 7}, .sampling = Sampling::kArea}});
  measure.add(fine, coarse, {});
  measure.add(fine, test::scaled(coarse, 0.5f), {});
  const nlohmann::ordered_json sampling = report_json(measure)["sampling"];
  EXPECT_EQ(sampling["kind"], "area");
  EXPECT_EQ(sampling["seed"], 7);
  EXPECT_EQ(sampling["original_samples"], 3000);
  EXPECT_EQ(sampling["approximation_samples"], 3000);
  const auto frames = measure.frames();
  const double largest = std::max(frames[0].distance.rms_error, frames[1].distance.rms_error);
  EXPECT_GT(largest, 0);
  EXPECT_DOUBLE_EQ(sampling["rms_within_95"], 1.96 * largest);
  const std::string line = sampling_line(measure);
  EXPECT_EQ(line.substr(0, 77), "3000 samples on the original and 3000 on the approximation, uniform by area, ")
      << line;
  EXPECT_THAT(line, testing::HasSubstr("seed 7; rms to within "));
}

TEST(ReportTable, HasNoSummaryForOneFrame) { EXPECT_EQ(lines(report_table(measure_frames(1))).size(), 2u); }

}  // namespace
}  // namespace limber::eval
