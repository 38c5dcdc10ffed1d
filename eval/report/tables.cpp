// SPDX-License-Identifier: Apache-2.0
#include "eval/report/tables.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <limits>

#include "eval/report/words.h"

namespace limber::eval {
namespace {

// Of what is compared in the summary: a method that changes fewer triangles than this per frame keeps them.
constexpr double kCalm = 0.1;

template <class Value>
double frame_mean(const Contender& contender, const Value& value) {
  double sum = 0;
  for (const MethodFrame& frame : contender.frames) sum += value(frame);
  return sum / static_cast<double>(contender.frames.size());
}

template <class Value>
double measure_mean(const Contender& contender, const Value& value) {
  double sum = 0;
  for (const FrameMeasure& frame : contender.measure.frames()) sum += value(frame);
  return sum / static_cast<double>(contender.measure.frames().size());
}

enum class Better { kLess, kMore, kNeither };

constexpr double kLeastTime = 0.001;  // of ms and s alike: what is shorter is noise

struct Column {
  std::string head;
  std::string unit;
  Better better = Better::kLess;
  std::vector<double> values{};  // [contenders]; not a number where there is none
};

double mean_or_nan(const std::optional<Statistic>& statistic) {
  return statistic ? statistic->mean : std::numeric_limits<double>::quiet_NaN();
}

std::vector<Column> summary_columns(const Comparison& comparison) {
  const std::string first(comparison.contenders().front().info->name);
  std::vector<Column> columns = {
      {"RMS", "% of diag."},
      {"worst RMS", "% of diag."},
      {"RMS", "\xc3\x97 " + first},
      {"mean", "% of diag."},
      {"max", "% of diag."},
      {"flicker", "% of diag."},
      {"changed", "% per frame"},
      {"QEM", "diag.\xe2\x81\xb4"},
      {"inverted", "per frame"},
      {"angles", "least, \xc2\xb0", Better::kMore},
      {"adapt", "ms"},
      {"list", "ms", Better::kNeither},
      {"begin", "s", Better::kNeither},
  };
  for (std::size_t i = 0; i < comparison.contenders().size(); ++i) {
    const Contender& c = comparison.contenders()[i];
    const ClipSummary s = c.measure.summary();
    const double values[] = {s.rms.mean,
                             s.rms.worst,
                             comparison.relative(i).rms_by_frame,
                             s.mean.mean,
                             s.max.mean,
                             mean_or_nan(s.flicker),
                             100 * mean_or_nan(s.changed),
                             mean_or_nan(quadric_errors(c)),
                             s.inverted.mean,
                             measure_mean(c, [](const FrameMeasure& f) { return f.quality.mean_angle; }),
                             1000 * frame_mean(c, [](const MethodFrame& f) { return f.adapt_seconds; }),
                             1000 * frame_mean(c, [](const MethodFrame& f) { return f.extract_seconds; }),
                             c.begin_seconds};
    for (std::size_t k = 0; k < columns.size(); ++k) columns[k].values.push_back(values[k]);
  }
  return columns;
}

// What is worth standing out: the best where not nearly all are.
std::optional<double> best_of(const Column& column) {
  std::vector<double> values;
  std::copy_if(column.values.begin(), column.values.end(), std::back_inserter(values),
               [](double v) { return std::isfinite(v); });
  if (column.better == Better::kNeither || values.size() < 2) return std::nullopt;
  const double best = column.better == Better::kLess ? *std::min_element(values.begin(), values.end())
                                                     : *std::max_element(values.begin(), values.end());
  const auto ties = std::count(values.begin(), values.end(), best);
  return 2 * ties > static_cast<std::ptrdiff_t>(values.size()) ? std::nullopt : std::optional(best);
}

std::string shown(const Column& column, double value) {
  const bool is_time = column.unit == "ms" || column.unit == "s";
  return is_time && value < kLeastTime ? fmt::format("&lt;{}", number(kLeastTime, 1)) : number(value);
}

std::string method_cell(const Contender& contender, std::size_t place) {
  return fmt::format("<th scope=\"row\" title=\"{}\">{}{}</th>", escaped(contender.info->description),
                     swatch(MethodMark{place}), escaped(contender.info->name));
}

double changed(const Contender& contender) {
  const std::optional<Statistic> statistic = contender.measure.summary().changed;
  return statistic ? statistic->mean : 0.0;
}

}  // namespace

std::string summary_sentence(const Comparison& comparison) {
  const std::span<const Contender> contenders = comparison.contenders();
  const auto by_rms = [](const Contender& a, const Contender& b) {
    return a.measure.summary().rms.mean < b.measure.summary().rms.mean;
  };
  const Contender& best = *std::min_element(contenders.begin(), contenders.end(), by_rms);
  const auto strong = [](const Contender& c) { return fmt::format("<b>{}</b>", escaped(c.info->name)); };
  const auto change = [](const Contender& c) {
    return changed(c) > 0 ? fmt::format("changes {} % of its triangles per frame", number(100 * changed(c)))
                          : std::string("never changes its triangles");
  };
  const double best_rms = best.measure.summary().rms.mean;
  std::string text = fmt::format("{} is nearest to the original, at an RMS distance of {} % of the diagonal, and {}",
                                 strong(best), number(best_rms), change(best));
  const Contender* calm = nullptr;
  for (const Contender& c : contenders) {
    if (changed(c) < kCalm && (calm == nullptr || by_rms(c, *calm))) calm = &c;
  }
  if (calm == nullptr || calm == &best || contenders.size() < 2) return text + ".";
  return text + fmt::format(
                    "; of the methods that change fewer than a tenth, {} is nearest, at {} times that distance: it {}.",
                    strong(*calm), number(best_rms > 0 ? calm->measure.summary().rms.mean / best_rms : 1.0),
                    change(*calm));
}

std::string summary_table(const Comparison& comparison) {
  const std::vector<Column> columns = summary_columns(comparison);
  std::string html = "<div class=\"scroll\"><table>\n<thead><tr><th scope=\"col\">method</th>";
  for (const Column& column : columns)
    html += fmt::format("<th scope=\"col\">{}<span>{}</span></th>", escaped(column.head), escaped(column.unit));
  html += "</tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < comparison.contenders().size(); ++i) {
    html += "<tr>" + method_cell(comparison.contenders()[i], i);
    for (const Column& column : columns) {
      const double value = column.values[i];
      const bool is_best = std::isfinite(value) && best_of(column) == value;
      html += fmt::format("<td{}>{}</td>", is_best ? " class=\"best\"" : "", shown(column, value));
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string storage_table(const Report& report) {
  std::string html =
      "<div class=\"scroll\"><table class=\"storage\">\n<thead><tr><th scope=\"col\">stored</th><th scope=\"col\" "
      "class=\"text\">as</th><th scope=\"col\">connectivity<span>per frame</span></th><th "
      "scope=\"col\">positions<span>per frame</span></th><th scope=\"col\">in all</th></tr></thead>\n<tbody>\n";
  const auto bytes = [](const std::optional<double>& value) { return value ? byte_count(*value) : number(value); };
  for (const StorageRow& row : report.storage) {
    html +=
        fmt::format("<tr><th scope=\"row\">{}{}</th><td class=\"text\">{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                    row.mark ? swatch(*row.mark) : "", escaped(row.what), escaped(row.how), bytes(row.connectivity),
                    bytes(row.positions), byte_count(row.total));
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace limber::eval
