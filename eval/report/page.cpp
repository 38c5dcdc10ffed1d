// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <fmt/format.h>
#include <optional>

#include "eval/color_map.h"
#include "eval/report/charts.h"
#include "eval/report/report.h"
#include "eval/report/report_charts.h"
#include "eval/report/style.h"
#include "eval/report/tables.h"
#include "eval/report/words.h"

namespace limber::eval {
namespace {

std::string name_of(const Report& report, std::size_t method) {
  return std::string(report.comparison.contenders()[method].info->name);
}

std::string first_name(const Report& report) { return name_of(report, 0); }

std::size_t frame_count(const Report& report) { return report.comparison.contenders().front().frames.size(); }

// A chart for wide and one for narrow windows, the second with a key.
template <class Draw>
std::string in_both_sizes(const Report& report, const Draw& draw) {
  std::string html = fmt::format("<div class=\"wide\">{}</div>\n<div class=\"narrow\">{}<ul class=\"key\">",
                                 draw(Room::kWide), draw(Room::kNarrow));
  for (std::size_t m = 0; m < report.comparison.contenders().size(); ++m)
    html += fmt::format("<li>{}{}</li>", swatch(MethodMark{m}), escaped(name_of(report, m)));
  return html + "</ul></div>\n";
}

std::string figure(std::string_view body, std::string_view caption) {
  return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", body, caption);
}

std::string frame_chart(const Report& report, const FrameChart& chart) {
  return in_both_sizes(report, [&](Room room) { return draw_frame_chart(chart, room); });
}

std::string heading(const Report& report) {
  const ClipFacts& clip = report.clip;
  const std::size_t methods = report.comparison.contenders().size();
  return fmt::format(
      "<h1>{}: {} method{} side by side</h1>\n<p class=\"facts\">{} frame{} of {} vertices and {} triangles, each "
      "simplified to {}.</p>\n<p>{}</p>\n",
      escaped(clip.name), methods, methods == 1 ? "" : "s", count(frame_count(report)),
      frame_count(report) == 1 ? "" : "s", count(clip.vertex_count), count(clip.triangle_count),
      escaped(report.run.asked), summary_sentence(report.comparison));
}

std::string peer_note(const Report& report) {
  const auto is_peer = [](const Contender& contender) { return contender.info->peer; };
  if (std::ranges::none_of(report.comparison.contenders(), is_peer)) return {};
  return " Of other projects\xe2\x80\x99 methods, copying the mesh into their own structures is not "
         "counted; a dash: not known.";
}

std::string left_out(const Report& report) {
  std::string html;
  for (const LeftOut& method : report.run.left_out)
    html += fmt::format(" <code>{}</code> is left out, it cannot take this clip: {}.", escaped(method.method),
                        escaped(method.why));
  return html;
}

std::string summary_section(const Report& report) {
  return "<section id=\"summary\">\n" + heading(report) + summary_table(report.comparison) +
         fmt::format(
             "<p class=\"note\"><b>Table 1.</b> Means over the frames; the best of a column is bold. Distances are "
             "between "
             "the surfaces, the larger of the two directions, in percent of the diagonal of the frame\xe2\x80\x99s "
             "bounding "
             "box. <i>\xc3\x97 {0}</i>: mean over the frames of RMS over that of {0}. <i>flicker</i>: how much the "
             "error "
             "itself moves from frame to frame. <i>changed</i>: triangles that were not there in the frame before. "
             "<i>QEM</i>: the quadric error, in the fourth power of the diagonal. <i>angles</i>: each "
             "triangle\xe2\x80\x99s "
             "least angle; 60\xc2\xb0 is the best there is. <i>adapt</i>: deciding what a frame is made of; "
             "<i>list</i>: "
             "listing its triangles; <i>begin</i>: once, before the first frame. Times are of one "
             "thread.{1}{2}</p>\n</section>\n",
             escaped(first_name(report)), peer_note(report), left_out(report));
}

std::string error_section(const Report& report) {
  std::string body = frame_chart(report, rms_chart(report));
  if (const std::optional<FrameChart> near = near_rms_chart(report)) {
    body += fmt::format("<h3>Magnified <span>without what is far from {}</span></h3>\n", escaped(first_name(report)));
    body += frame_chart(report, *near);
  }
  return "<section id=\"rms\">\n<h2>Error per frame</h2>\n" +
         figure(body,
                "<b>Figure 1.</b> RMS distance to the original in every frame. Lower is nearer; a line that rises to "
                "the right gathers error. Rest the pointer on a frame for its numbers. Answers Fig. 11 of Kircher and "
                "Garland (2005).") +
         "</section>\n";
}

std::string trade_off_section(const Report& report) {
  const TradeOff chart = trade_off_chart(report);
  std::string html = "<section id=\"trade-off\">\n<h2>Error against change</h2>\n<figure>";
  html += fmt::format("<div class=\"wide\">{}</div><div class=\"narrow\">{}</div>", draw_trade_off(chart, Room::kWide),
                      draw_trade_off(chart, Room::kNarrow));
  html += fmt::format(
      "<figcaption><b>Figure 2.</b> What a method pays for its error. To the left are those whose triangles stay, so "
      "that "
      "textures, normals and the eye stay with them; below are those nearest to the original. The lower left corner is "
      "where one would like to be. Small shares are spread (a square root scale). The dotted line is {}; rings are "
      "methods whose lines are broken "
      "elsewhere.</figcaption>"
      "</figure>\n</section>\n",
      escaped(first_name(report)));
  return html;
}

std::string time_section(const Report& report) {
  return "<section id=\"time\">\n<h2>Time to adapt</h2>\n" +
         figure(frame_chart(report, adapt_chart(report)),
                "<b>Figure 3.</b> Processor time that deciding what a frame is made of takes, on one thread and "
                "without listing the triangles; note the logarithmic scale. Answers Fig. 13 of Kircher and Garland "
                "(2005), who show the time to play updates that were computed beforehand: <code>limber play</code> "
                "prints that.") +
         "</section>\n";
}

std::string storage_section(const Report& report) {
  return "<section id=\"storage\">\n<h2>Storage</h2>\n" + storage_table(report) +
         "<p class=\"note\"><b>Table 2.</b> What has to be stored to show the clip. Methods: one level of detail, as "
         "plain "
         "numbers: 32-bit indices, again in every frame where triangles change, and three floats per vertex. Answers "
         "the "
         "figures in section 6 of Kircher and Garland (2005): 2.2 KB of swaps per frame and 103.4 KB for a whole "
         "hierarchy in every frame of their collapsing horse." +
         std::string(report.stream
                         ? " The stream was made for this table, from this clip and with a level of this size."
                         : "") +
         "</p>\n</section>\n";
}

std::string histogram_section(const Report& report) {
  std::string html = "<section id=\"histograms\">\n<h2>Error over the surface</h2>\n<figure><div class=\"small\">\n";
  const std::vector<Histogram> histograms = distance_histograms(report);
  for (std::size_t m = 0; m < histograms.size(); ++m) {
    html += fmt::format("<div><h3>{}{} <span>95 of 100 below {} %</span></h3>{}</div>\n", swatch(MethodMark{m}),
                        escaped(name_of(report, m)), number(histograms[m].marked), draw_histogram(histograms[m]));
  }
  return html +
         fmt::format(
             "</div><figcaption><b>Figure 4.</b> How the distance from the original to each approximation is spread "
             "over "
             "the surface, all frames together: {} points, fixed on the surface. More to the left is better; the "
             "last, paler bar holds all beyond. The outline is {}, the broken line the 95th percentile. Answers Fig. 7 "
             "of "
             "Kircher and Garland (2005).</figcaption></figure>\n</section>\n",
             count(report.places.sample_count()), escaped(first_name(report)));
}

std::string picture(const PictureRow& row, std::size_t i, const std::string& what) {
  return fmt::format("<img alt=\"{}\" width=\"{}\" height=\"{}\" src=\"data:image/png;base64,{}\"/>", escaped(what),
                     row.width, row.height, row.pictures[i]);
}

// `words(method)`: what stands below a picture.
template <class Words>
std::string tiles(const Report& report, const PictureRow& row, std::optional<std::size_t> blamed, const Words& words) {
  const std::size_t frame = report.clip.first_frame + row.frame;
  std::string html =
      fmt::format("<div class=\"tiles\">\n<figure>{}<figcaption><b>original</b>{} vertices</figcaption></figure>\n",
                  picture(row, 0, fmt::format("frame {}, original", frame)), count(report.clip.vertex_count));
  for (std::size_t m = 0; m + 1 < row.pictures.size(); ++m) {
    html += fmt::format("<figure class=\"{}{}\">{}<figcaption><b>{}{}</b>{}</figcaption></figure>\n",
                        MethodMark{m}.color_class(), blamed == m ? " blamed" : "",
                        picture(row, m + 1, fmt::format("frame {}, {}", frame, name_of(report, m))),
                        swatch(MethodMark{m}), escaped(name_of(report, m)), words(m));
  }
  return html + "</div>\n";
}

std::string rms_words(double rms) { return fmt::format("RMS {} %", number(rms)); }

std::string color_ramp(double range) {
  std::string stops;
  for (int i = 0; i <= 16; ++i) {
    const Rgba8 c = map_pixel(ColorMap::kHeat, static_cast<float>(i) / 16);
    stops += fmt::format("{}rgb({},{},{})", i == 0 ? "" : ",", c.r, c.g, c.b);
  }
  return fmt::format(
      "<div class=\"ramp\"><span>0</span><i style=\"background:linear-gradient(to right,{})\"></i><span>{} % of the "
      "diagonal and more</span></div>\n",
      stops, number(range));
}

std::string gallery_section(const Report& report) {
  const std::span<const FrameMeasure> first = report.comparison.contenders().front().measure.frames();
  std::size_t worst = 0;
  for (std::size_t t = 0; t < first.size(); ++t) {
    if (first[t].distance.rms > first[worst].distance.rms) worst = t;
  }
  std::string html = "<section id=\"gallery\">\n<h2>Frames</h2>\n<figure class=\"pictures\">" +
                     color_ramp(report.pictures.error_range);
  for (const PictureRow& row : report.pictures.gallery) {
    const bool is_worst = row.frame == worst && first.size() > 1;
    html += fmt::format("<h3>Frame {}{}</h3>\n", report.clip.first_frame + row.frame,
                        is_worst ? fmt::format(" <span>where {} is worst</span>", escaped(first_name(report))) : "");
    html += tiles(report, row, {}, [&](std::size_t m) {
      return rms_words(report.comparison.contenders()[m].measure.frames()[row.frame].distance.rms);
    });
  }
  return html +
         "<figcaption><b>Figure 5.</b> The same view of what every method makes of a frame, with its triangles. Colour "
         "is "
         "the distance of the approximation from the original. Pale is near; equal colours are equal distances in all "
         "pictures. Answers Fig. 1, 9, 10 and 14 of Kircher and Garland (2005).</figcaption></figure>\n</section>\n";
}

std::string close_up_section(const Report& report) {
  std::string html = "<section id=\"close-ups\">\n<h2>Worst places</h2>\n<figure class=\"pictures\">" +
                     color_ramp(report.pictures.error_range);
  for (const CloseUp& close_up : report.pictures.close_ups) {
    html += fmt::format("<h3>{}{} <span>in frame {}: RMS {} % here{}</span></h3>\n",
                        swatch(MethodMark{close_up.method}), escaped(name_of(report, close_up.method)),
                        report.clip.first_frame + close_up.place.frame, number(close_up.place.rms[close_up.method]),
                        close_up.method == 0
                            ? ""
                            : fmt::format(", {} {} %", escaped(first_name(report)), number(close_up.place.rms[0])));
    html +=
        tiles(report, close_up.row, close_up.method, [&](std::size_t m) { return rms_words(close_up.place.rms[m]); });
  }
  return html +
         fmt::format(
             "<figcaption><b>Figure 6.</b> Where in the whole clip a method (outlined) loses most against {}, found by "
             "the "
             "program: of all neighbourhoods a twentieth of the diagonal wide, in all frames, the one with the largest "
             "sum "
             "of squared distances more than there. Rows go from the method that loses most to the one that loses "
             "least. "
             "The RMS below a picture is that of the neighbourhood in its middle.</figcaption></figure>\n</section>\n",
             escaped(first_name(report)));
}

std::string parts_section(const Report& report, int figure_number) {
  const Parts& parts = *report.parts;
  std::string html =
      "<section id=\"parts\">\n<h2>Parts</h2>\n<div class=\"scroll\"><table>\n<thead><tr><th scope=\"col\">method</th>";
  for (std::size_t part = 0; part < parts.size(); ++part) {
    html += fmt::format("<th scope=\"col\">{0}<span>triangles</span></th><th scope=\"col\">{0}<span>RMS, %</span></th>",
                        escaped(parts.ball(part).name));
  }
  html += "</tr></thead>\n<tbody>\n<tr><th scope=\"row\">the original</th>";
  for (std::size_t part = 0; part < parts.size(); ++part)
    html += fmt::format("<td>{}</td><td>{}</td>", count(parts.triangles(part).size()), number(std::optional<double>()));
  html += "</tr>\n";
  for (std::size_t m = 0; m < report.comparison.contenders().size(); ++m) {
    html += fmt::format("<tr><th scope=\"row\">{}{}</th>", swatch(MethodMark{m}), escaped(name_of(report, m)));
    for (std::size_t part = 0; part < parts.size(); ++part) {
      const PartMeasure measure = parts.measure(part, m);
      html += fmt::format("<td>{}</td><td>{}</td>", number(measure.triangles), number(measure.rms));
    }
    html += "</tr>\n";
  }
  html +=
      "</tbody></table></div>\n<p class=\"note\"><b>Table 3.</b> What each method spends on the parts that were asked "
      "for, and how near it comes to them: means over the frames. A part is what of the first frame lies in a ball, "
      "and the same surface in every other; a triangle belongs to it where the middle of the triangle is nearest to "
      "that surface.</p>\n<figure class=\"pictures\">" +
      color_ramp(report.pictures.error_range);
  for (std::size_t part = 0; part < report.pictures.parts.size(); ++part) {
    const PictureRow& row = report.pictures.parts[part];
    html += fmt::format("<h3>{} <span>in frame {}</span></h3>\n", escaped(parts.ball(part).name),
                        report.clip.first_frame + row.frame);
    html += tiles(report, row, {}, [&](std::size_t m) {
      return fmt::format("{} triangles", count(static_cast<std::uint64_t>(parts.measure(part, m).last_triangles)));
    });
  }
  return html + fmt::format(
                    "<figcaption><b>Figure {}.</b> The parts in the last frame, with the triangles that are spent on "
                    "them there. Answers Fig. 4 and 5 of Zhang and Wu (2007).</figcaption></figure>\n</section>\n",
                    figure_number);
}

std::string made_section(const Report& report) {
  const RunFacts& run = report.run;
  const Distance& distance = report.comparison.contenders().front().measure.frames().front().distance;
  std::string html = "<section id=\"made\">\n<h2>How this was made</h2>\n<pre>";
  for (const std::string& command : run.commands) html += escaped(command) + "\n";
  html += "</pre>\n<div class=\"scroll\"><table class=\"facts-table\"><tbody>\n";
  const auto fact = [&](std::string_view name, const std::string& value) {
    html += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", name, escaped(value));
  };
  fact("clip",
       fmt::format("{}: frames {} to {}, {} per second; {} vertices, {} triangles; diagonal of the first frame {}",
                   report.clip.name, report.clip.first_frame, report.clip.first_frame + frame_count(report) - 1,
                   number(report.clip.frames_per_second), count(report.clip.vertex_count),
                   count(report.clip.triangle_count), number(distance.diagonal, 4)));
  fact("samples",
       fmt::format(
           "{} on the original and {} on each approximation in the first frame, {}, seed {}; standard error of the RMS "
           "there {} % of the diagonal",
           count(distance.to_approximation.sample_count), count(distance.to_original.sample_count),
           run.distance.sampling == Sampling::kMetro ? "vertices, edges and faces as Metro" : "uniform by area",
           run.distance.samples.seed, number(distance.rms_error, 2)));
  fact("program", fmt::format("limber {}, {}", run.version, run.compiler));
  fact("machine", fmt::format("{}; {} thread{}", run.processor, run.threads, run.threads == 1 ? "" : "s"));
  fact("date", run.date);
  for (const Contender& contender : report.comparison.contenders())
    fact(fmt::format("<code>{}</code>", escaped(contender.info->name)), std::string(contender.info->description));
  return html +
         "</tbody></table></div>\n<p class=\"note\">All numbers are in <code>report.json</code> and, frame by frame, "
         "in "
         "<code>frames.csv</code> beside this page. Kircher and Garland (2005): Progressive Multiresolution Meshes for "
         "Deforming Surfaces, Symposium on Computer Animation, 191\xe2\x80\x93"
         "200.</p>\n</section>\n";
}

}  // namespace

std::string report_page(const Report& report) {
  std::string page =
      fmt::format(
          "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<meta name=\"viewport\" "
          "content=\"width=device-width, initial-scale=1\"/>\n<meta name=\"generator\" content=\"limber {}\"/>\n"
          "<title>{}: methods side by side</title>\n<style>{}</style>\n</head>\n<body>\n",
          escaped(report.run.version), escaped(report.clip.name), report_style()) +
      summary_section(report) + error_section(report) + trade_off_section(report) + time_section(report) +
      storage_section(report) + histogram_section(report) + gallery_section(report) + close_up_section(report);
  int figure_number = 7;
  if (report.parts != nullptr && report.parts->size() > 0) page += parts_section(report, figure_number++);
  if (!report.sweeps.empty()) page += sweep_section(report.sweeps, first_name(report), figure_number);
  return page + made_section(report) + "</body>\n</html>\n";
}

}  // namespace limber::eval
