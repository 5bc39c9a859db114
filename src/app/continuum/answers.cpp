// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>

#include "analysis/hopper.hpp"
#include "analysis/hopper_estimators.hpp"
#include "app/continuum/design_code.hpp"
#include "app/continuum/engineering_units.hpp"
#include "app/continuum/hand_formulas.hpp"
#include "io/series.hpp"

namespace talus::app {

namespace {

using continuum::VesselShape;

constexpr double hardly = 0.05;     // of the largest pressure on any wall
constexpr double mass_flow = 0.99;  // of the particles move: measure share_that_moves
constexpr double arch = 0.3;        // of the bed's packing above the outlet: measure outlet_packing
constexpr double to_start = 3;      // times (D/g)^(1/2): grains that have not begun to flow by then do not

/// A quantity of the summary; nan if it has none.
double value_of(const std::vector<NamedValue>& quantities, std::string_view name) {
  const auto found =
      std::find_if(quantities.begin(), quantities.end(), [&](const NamedValue& q) { return q.name == name; });
  return found != quantities.end() ? found->value : no_value;
}

std::string formula_of_discharge(const continuum::Layout& layout) {
  const auto& outlets = layout.vessel_outlets;
  if (outlets.empty() || !outlets.front().round) return "Beverloo by the hydraulic diameter, flat bottom";
  return half_angle_of_cone(layout) < std::numbers::pi / 4 ? "Beverloo; Rose & Tanaka" : "Beverloo";  // nan: no cone
}

const char* regime_of(bool all_moves) {
  return all_moves ? "mass flow" : "funnel flow";
}

std::string too_little_left(double discharged) {
  return fmt::format("not yet known: {} has left, {} needed", share_text(discharged),
                     share_text(hopper::share_of_regime));
}

/// Of each of several outlets what passes it.
std::vector<Answer> answers_of_outlets(const continuum::Layout& layout, const std::vector<NamedValue>& quantities) {
  std::vector<Answer> answers;
  const double from = value_of(quantities, "discharge_steady_from"), to = value_of(quantities, "discharge_steady_to");
  for (const continuum::VesselOutlet& outlet : layout.vessel_outlets) {
    const double rate = value_of(quantities, "discharge_rate_" + outlet.name),
                 hand = value_of(quantities, "discharge_rate_beverloo_" + outlet.name);
    const bool was_shut = from < to && outlet.gate && !(outlet.gate->time_away(from, to) > 0);
    if (!std::isfinite(rate) && !was_shut) continue;
    answers.push_back(
        {"Steady discharge through " + outlet.name,
         was_shut ? fmt::format("shut from {} to {}", time_text(from), time_text(to)) : rate_text(rate, no_value),
         {}});
    if (hand > 0) answers.back().by_hand = rate_text(hand, no_value);
  }
  return answers;
}

/// The flow through the outlet. \param of a quantity of the summary
class FlowAnswers {
 public:
  FlowAnswers(const continuum::Setup& setup, const std::vector<NamedValue>& quantities, double end_of_run)
      : setup_(setup), quantities_(quantities), left_(of("residual_fraction")), end_(end_of_run) {}

  std::vector<Answer> all() const {
    if (!std::isfinite(left_)) return {};
    std::vector<Answer> answers = {end()};
    if (const auto outlet = critical_outlet_by_hand(setup_)) answers.push_back(critical_outlet(*outlet));
    if (!setup_.given.vessel.empty()) answers.push_back(regime());
    answers.push_back(steady_discharge());
    if (const double peak = of("discharge_rate_max"); peak > 0 && discharged() > 1e-9)
      answers.push_back(
          {fmt::format("Peak discharge ({} average)", time_text(setup_.scales.averaging_time)),
           fmt::format("{} after {}", rate_text(peak, no_value), time_text(of("discharge_rate_max_time"))),
           {}});
    answers.push_back({"Emptying time (99 %)",
                       std::isfinite(of("emptying_time")) ? time_text(of("emptying_time")) : "not reached",
                       {}});
    if (const double estimate = of("emptying_time_by_hand"); estimate > 0)
      answers.back().by_hand = time_text(estimate) + " (at the estimated discharge)";
    return answers;
  }

 private:
  double of(std::string_view name) const { return value_of(quantities_, name); }
  double discharged() const { return 1 - left_; }
  std::string too_little() const { return too_little_left(discharged()); }

  Answer end() const {
    const std::string rest = of("residual_mass") > 0 ? fmt::format("{} ({}) left", mass_text(of("residual_mass")),
                                                                   share_text(std::abs(left_)))
                                                     : "nothing left";
    const double stopped = of("flow_stop_time"), emptied = of("emptying_time");
    const double slack = 3 * setup_.scales.averaging_time;  // a gate that closed later found the flow stopped
    Answer answer{.question = "Flow", .answer = {}};
    if (std::isfinite(emptied))
      answer.answer = fmt::format("has emptied after {}, {}", time_text(emptied), rest);
    else if (const auto shut = setup_.boundary->shut_since(end_); shut && !(stopped < *shut - slack))
      answer.answer = fmt::format("was shut after {}: {}", time_text(*shut), rest);
    else if (const double opens = continuum::first_opening(setup_.vessel_outlets); opens > 0 && !(end_ > opens))
      answer.answer = fmt::format("was shut until the end of the run: {}", rest);
    else if (is_cohesive() && has_arch() &&
             (std::isfinite(stopped) || (!(discharged() > 1e-9) && end_ - opens > to_start * setup_.scales.time)))
      answer.answer =
          fmt::format("arched at {}, over the outlet: {}", std::isfinite(stopped) ? time_text(stopped) : "once", rest);
    else if (std::isfinite(stopped))
      answer.answer = fmt::format("has stopped after {} with {}: {}", time_text(stopped), rest,
                                  has_arch()     ? "arch over the outlet"
                                  : is_rathole() ? "rathole"
                                                 : "stagnant at its angle of repose");
    else if (!(discharged() > 1e-9))
      answer.answer = fmt::format("has not started: {}", rest);
    else
      answer.answer = fmt::format("still flows at the end of the run: {}", rest);
    return answer;
  }

  bool is_cohesive() const { return continuum::has_cohesion(setup_.given); }
  bool has_arch() const { return of("outlet_packing") >= arch * setup_.given.bed.packing; }
  /// Higher than what slopes leave beside the outlet.
  bool is_rathole() const { return is_cohesive() && of("rathole_height") > 1.5 * setup_.outlet_width.value_or(0); }

  Answer critical_outlet(const granular::CriticalOutlet& outlet) const {
    const std::string by_hand = std::isinf(outlet.width) ? "any arches"
                                : outlet.width > 0       ? length_text(outlet.width)
                                                         : "none";
    const std::string stress =
        outlet.strength > 0 ? fmt::format(": flow factor {:.3g}, f_c {}", outlet.factor, pressure_text(outlet.strength))
                            : "";
    return {"Critical outlet", fmt::format("{} here", length_text(setup_.outlet_width.value_or(0))),
            fmt::format("{} (Jenike{})", by_hand, stress)};
  }

  Answer regime() const {
    Answer answer{.question = "Flow regime", .answer = {}};
    if (const double share = of("share_that_moves"); std::isfinite(share))
      answer.answer = fmt::format("{}, stagnant zone {}", regime_of(share >= mass_flow), share_text(1 - share));
    else
      answer.answer = discharged() < hopper::share_of_regime ? too_little() : "not known: no snapshots while it flowed";
    const double own = half_angle_of_cone(setup_) * 180 / std::numbers::pi, most = of("mass_flow_half_angle_jenike");
    if (std::isfinite(own) && std::isfinite(most))
      answer.by_hand = fmt::format(
          "{}, half angle {:.3g}° of at most {:.0f}° (Jenike, grains of {:.3g}° in plane strain)",
          regime_of(own <= most), own, most, internal_friction_by_hand(setup_.given) * 180 / std::numbers::pi);
    return answer;
  }

  Answer steady_discharge() const {
    const double rate = of("discharge_steady"), error = of("discharge_steady_error"),
                 estimate = of("discharge_rate_beverloo");
    Answer answer{.question = "Steady discharge", .answer = {}};
    if (std::isfinite(rate))
      answer.answer =
          rate_text(rate, error) + (std::isfinite(error) ? " (95 % interval)" : " (too short for an uncertainty)");
    else
      answer.answer =
          discharged() < hopper::steady_from ? too_little() : "none: it did not stay within 10 % for long enough";
    if (estimate > 0)
      answer.by_hand = fmt::format("{} ({})", rate_text(estimate, no_value), formula_of_discharge(setup_));
    return answer;
  }

  const continuum::Setup& setup_;
  const std::vector<NamedValue>& quantities_;
  double left_, end_;
};

/// The rows of a table of loads that are of one wall.
class LoadsOfWall {
 public:
  LoadsOfWall(const Series& table, std::string_view column, double wall) : table_(table) {
    const auto of = table.column(column);
    for (std::size_t n = 0; n < of.size(); ++n)
      if (of[n] == wall) rows_.push_back(n);
  }

  /// The row with the largest value; nothing where there is none, or where all are below `least`.
  std::optional<std::size_t> largest(std::string_view column, double least) const {
    const auto values = table_.column(column);
    std::optional<std::size_t> found;
    for (const std::size_t n : rows_)
      if (values[n] > least && (!found || values[n] > values[*found])) found = n;
    return found;
  }

  double at(std::string_view column, std::size_t row) const {
    return table_.has(column) ? table_.column(column)[row] : no_value;
  }

  /// Of the row's band, m.
  double middle(std::size_t row) const { return 0.5 * (at("low", row) + at("high", row)); }

  /// "1.2 kPa at z = 75 mm"; the height where it is given and the wall is not level.
  std::string text(std::string_view column, std::size_t row) const {
    std::string text = pressure_text(at(column, row));
    if (at("high", row) > at("low", row)) text += fmt::format(" at z = {}", length_text(middle(row)));
    return text;
  }

 private:
  const Series& table_;
  std::vector<std::size_t> rows_;
};

/// One of the pressures on a wall, and its estimates.
struct Kind {
  enum class When { at_rest, in_flow, at_peak } when;
  std::string title;
  const char *pressure, *by_hand, *of_code, *load_case;

  bool is_of_flow() const { return when != When::at_rest; }
};

/// "1.04 kPa (Walker, ...), 0.9 kPa (Enstad, the same), EN 1991-4: 1.5 kPa discharge, upper value".
std::string estimates_of(const LoadsOfWall& loads, const Kind& kind, std::size_t row, std::string_view formula) {
  std::string text;
  if (const double hand = loads.at(kind.by_hand, row); std::isfinite(hand))
    text = fmt::format("{} ({})", pressure_text(hand), formula);
  if (const double arcs = loads.at("pressure_in_flow_enstad", row); kind.is_of_flow() && std::isfinite(arcs))
    text += fmt::format(", {} (Enstad, the same)", pressure_text(arcs));
  if (const double code = loads.at(kind.of_code, row); std::isfinite(code))
    text +=
        fmt::format("{}EN 1991-4: {} {}, upper value", text.empty() ? "" : ", ", pressure_text(code), kind.load_case);
  return text;
}

/// What a table of loads is of.
struct LoadTable {
  const char *file, *column;
  std::size_t walls;
  std::function<std::string(std::size_t)> name;
  std::function<std::string(std::size_t, double, bool)> formula;  ///< at a height, m, at rest or in flow
  /// Of a band; empty: walls have none.
  std::function<std::string(std::size_t)> extent;
};

/// The area over which a pressure is a mean.
std::string area_text(const LoadTable& of, const LoadsOfWall& loads, std::size_t wall, std::size_t row) {
  if (!of.extent) return "all that the bed covers at the start";
  const double height = loads.at("high", row) - loads.at("low", row);
  return height > 0 ? fmt::format("band {} high, {}", length_text(height), of.extent(wall)) : "its whole area";
}

/// Of each wall the largest pressure at rest, in flow and at its peak; walls that carry almost no load are left out.
/// \param unknown why there is no flow to speak of; empty if there is one, or no outlet \param flows whether there is
std::vector<Answer> answers_of_walls(const continuum::Setup& setup, const Series& table, const LoadTable& of,
                                     bool flows, const std::string& unknown) {
  double most = 0;
  for (const std::string_view column : {"pressure_at_rest", "pressure_largest"})
    for (const double pressure : table.column(column))
      if (pressure > most) most = pressure;  // some may be nan
  const std::string peak = fmt::format("Peak pressure ({} average)", time_text(setup.scales.peak_time()));
  std::vector<Kind> kinds = {{Kind::When::at_rest, "Pressure at rest", "pressure_at_rest", "pressure_at_rest_by_hand",
                              "en_pressure_filling", "filling"}};
  if (flows || !unknown.empty())
    kinds.push_back({Kind::When::in_flow, "Pressure in flow", "pressure_in_flow", "pressure_in_flow_by_hand",
                     "en_pressure_discharge", "discharge"});
  kinds.push_back({Kind::When::at_peak, peak, "pressure_largest", "pressure_in_flow_by_hand", "en_pressure_discharge",
                   "discharge"});
  std::vector<Answer> answers;
  for (std::size_t w = 0; w < of.walls; ++w) {
    const LoadsOfWall loads(table, of.column, static_cast<double>(w + 1));
    const bool bears = loads.largest("pressure_largest", hardly * most).has_value();
    for (const Kind& kind : kinds) {
      const bool is_mean = kind.when == Kind::When::in_flow;
      const std::string question = fmt::format("{}, {}", kind.title, of.name(w));
      if (is_mean && !flows) {
        if (bears) answers.push_back({question, unknown, {}});
        continue;
      }
      if (!table.has(kind.pressure)) continue;
      // In flow a mean stands beside each peak, however small.
      const auto row = loads.largest(kind.pressure, is_mean && bears ? -1 : hardly * most);
      if (is_mean && bears && !row) answers.push_back({question, "not known: the run does not cover its window", {}});
      if (!row) continue;
      Answer answer{question, loads.text(kind.pressure, *row),
                    estimates_of(loads, kind, *row, of.formula(w, loads.middle(*row), kind.is_of_flow()))};
      if (kind.when == Kind::When::at_peak)
        answer.answer +=
            fmt::format(", after {}, {}", time_text(loads.at("time_of_largest", *row)), area_text(of, loads, w, *row));
      answers.push_back(std::move(answer));
    }
  }
  return answers;
}

/// The formula for a place on a vessel's wall, and what it takes of the bed and the wall: values of the case, no
/// limits.
std::string formula_at(const SiloShape& shape, const std::vector<NamedValue>& quantities, std::size_t part,
                       double height, bool flows) {
  const SiloPiece* const piece = shape.of_part(part, height);
  if (piece && piece->is_hopper()) {
    std::string text = fmt::format("Walker, μ {:.3g}", piece->friction);
    if (flows)
      text += fmt::format(", φ {:.3g}° in plane strain",
                          internal_friction_by_hand(shape.layout.given) * 180 / std::numbers::pi);
    return text;
  }
  const SiloPiece* const wall = piece ? piece : shape.upright_at(middle_of(shape, part, height));
  const double measured = value_of(quantities, "wall_pressure_ratio");
  const bool is_measured = std::isfinite(measured);
  return fmt::format("Janssen, K {:.3g} {}, μ {:.3g}", is_measured ? measured : pressure_ratio_at_rest(shape.layout),
                     is_measured ? "as measured" : "of the law at rest", wall ? wall->friction : no_value);
}

/// What inlets were to bring in, kg; nan where one of them is not over. \param end of the run, from the opening of the
/// gate, s
double asked_of_inlets(const continuum::Parameters& p, double end) {
  double mass = 0;
  for (const continuum::Inlet& inlet : p.inlets) {
    const bool is_before =
        inlet.clock == continuum::InletClock::start && p.gate.opens == continuum::GateOpens::when_settled;
    if (!(is_before ? end > 0 : end >= inlet.end())) return no_value;
    mass += inlet.rate * (inlet.end() - inlet.from);
  }
  return mass;
}

/// Of all inlets together, kg/s; nan where they come in at different times.
double rate_of_inlets(const continuum::Parameters& p) {
  double rate = 0;
  for (const continuum::Inlet& inlet : p.inlets) {
    if (inlet.from != p.inlets[0].from || inlet.end() != p.inlets[0].end()) return no_value;
    rate += inlet.rate;
  }
  return rate;
}

}  // namespace

std::vector<Answer> answers_of(const continuum::Setup& setup, const std::vector<NamedValue>& quantities, double end,
                               const std::filesystem::path& run_folder) {
  std::vector<Answer> answers = FlowAnswers(setup, quantities, end).all();
  const continuum::Parameters& p = setup.given;
  for (Answer& answer : answers_of_outlets(setup, quantities)) answers.push_back(std::move(answer));
  const double left = value_of(quantities, "residual_fraction");
  const bool flows = 1 - left >= hopper::share_of_regime;  // nan: no outlet
  if (const double slope = value_of(quantities, "repose_angle_bin"); std::isnan(left) && slope > 0)
    answers.push_back({"Slope of the heap at the end", fmt::format("{:.3g}°", slope), ""});
  if (const double error = value_of(quantities, "weight_balance_error_at_rest"); std::isfinite(error))
    answers.push_back({"Walls carry at rest", fmt::format("{:.1f} % of the weight", 100 * (1 + error)), "100 %"});
  const double outside = value_of(quantities, "outside_fraction");
  if (constexpr double notable = 0.001; outside > notable && p.box.floor != FaceKind::open)
    answers.push_back({"Beyond the box",
                       fmt::format("{:.2g} % of the bed; its walls and floor have no end there", 100 * outside), ""});
  const double asked = asked_of_inlets(p, end), fed = value_of(quantities, "fed_mass");
  if (constexpr double enough = 0.95; fed < enough * asked)
    answers.push_back(
        {"Fed", fmt::format("{} of {}: inlets had no room for more", mass_text(fed), mass_text(asked)), ""});
  if (const double rate = value_of(quantities, "throughput"); rate > 0) {
    const double comes = rate_of_inlets(p);
    answers.push_back({"Throughput, steady", rate_text(rate, value_of(quantities, "throughput_error")),
                       comes > 0 ? rate_text(comes, no_value) + " (inlets)" : ""});
  }
  if (const double lift = value_of(quantities, "air_lift"); std::isfinite(lift))
    answers.push_back({"Air bears at the end",
                       fmt::format("{:.1f} % of the weight, by a pressure difference of {}", 100 * lift,
                                   pressure_text(value_of(quantities, "air_pressure_difference"))),
                       ""});
  const std::string unknown = flows || !std::isfinite(left) ? std::string() : too_little_left(1 - left);
  const SiloShape shape(setup);
  const LoadTable of_vessel{
      "wall_loads.csv",
      "patch",
      p.vessel.size(),
      [&](std::size_t w) { return continuum::name_of(p, w); },
      [&](std::size_t w, double height, bool in_flow) { return formula_at(shape, quantities, w, height, in_flow); },
      [&](std::size_t w) { return p.vessel[w].shape == VesselShape::plate ? "whole width" : "whole circumference"; }};
  const LoadTable of_box{"box_walls.csv",
                         "wall",
                         setup.boundary->patches().size(),
                         [&](std::size_t w) { return setup.boundary->patches()[w].name; },
                         [](std::size_t, double, bool) { return "Janssen"; },
                         nullptr};
  for (const LoadTable* of : {&of_vessel, &of_box}) {
    const std::filesystem::path path = run_folder / "analysis" / of->file;
    if (!std::filesystem::exists(path)) continue;
    for (Answer& answer : answers_of_walls(setup, read_series(path), *of, flows, unknown))
      answers.push_back(std::move(answer));
  }
  for (Answer& answer : answers_of_code(shape, run_folder)) answers.push_back(std::move(answer));
  return answers;
}

}  // namespace talus::app
