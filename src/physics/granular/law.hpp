// SPDX-License-Identifier: Apache-2.0
/// The constitutive laws there are, and the table [law] of a case. A law is added by its header and a position in
/// AnyLaw: its name in law.name, its keys in [law.NAME], the schema, the reference page, `talus law` and the loop over
/// the particles follow. The loop visits the variant once, outside.
#pragma once

#include <array>
#include <concepts>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "base/parameter.hpp"
#include "physics/granular/critical_state.hpp"
#include "physics/granular/drucker_prager.hpp"
#include "physics/granular/linear_elastic.hpp"
#include "physics/granular/yuu_umekage_isotropic.hpp"
#include "physics/granular/yuu_umekage_printed.hpp"

namespace talus::granular {

/// All laws.
using AnyLaw = std::variant<YuuUmekageIsotropic, YuuUmekagePrinted, DruckerPrager, CriticalState, LinearElastic>;

template <class Variant>
struct LawsOf;
template <ConstitutiveLaw... Law>
struct LawsOf<std::variant<Law...>> {
  using Parameters = std::tuple<typename Law::Parameters...>;
  static constexpr std::array names{std::string_view(Law::name)...};
  static std::string text() {
    std::string list;
    ((list += (list.empty() ? "" : "; ") + std::string(Law::name) + ": " + std::string(Law::text)), ...);
    return list;
  }
  template <class P>
  static constexpr bool has_parameters = (std::same_as<P, typename Law::Parameters> || ...);
  /// Place of the law that has these parameters.
  template <class P>
  static constexpr std::size_t index_of() {
    std::size_t index = 0, at = 0;
    ((std::same_as<P, typename Law::Parameters> ? void(index = at++) : void(++at)), ...);
    return index;
  }
};
using Laws = LawsOf<AnyLaw>;

/// The position of a law in AnyLaw.
enum class LawName : std::size_t {};

/// The table [law] of a case, with a table of each law within.
struct LawParameters {
  LawName name{Laws::index_of<CriticalState::Parameters>()};
  Laws::Parameters own;

  LawParameters() = default;
  /// Chooses the law with these parameters; implicit, so that they can be passed as a law.
  template <class P>
  // NOLINTNEXTLINE(google-explicit-constructor)
  requires(Laws::has_parameters<P>) LawParameters(const P& parameters) : name(LawName{Laws::index_of<P>()}) {
    std::get<P>(own) = parameters;
  }

  template <class Law>
  bool is() const {
    return name == LawName{Laws::index_of<typename Law::Parameters>()};
  }
  template <class Law>
  typename Law::Parameters& of() {
    return std::get<typename Law::Parameters>(own);
  }
  template <class Law>
  const typename Law::Parameters& of() const {
    return std::get<typename Law::Parameters>(own);
  }
};

/// Calls body.template operator()<Law>(its parameters, its name) for every law.
template <class P, class Body>
void for_each_law(P& parameters, Body&& body) requires std::same_as<std::remove_const_t<P>, LawParameters> {
  [&]<std::size_t... k>(std::index_sequence<k...>) {
    (body.template operator()<std::variant_alternative_t<k, AnyLaw>>(std::get<k>(parameters.own), LawName{k}), ...);
  }
  (std::make_index_sequence<std::variant_size_v<AnyLaw>>());
}

/// What `body` makes of the parameters of the chosen law.
template <class Body>
auto with_chosen_law(const LawParameters& parameters, Body&& body) {
  using Result = decltype(body.template operator()<std::variant_alternative_t<0, AnyLaw>>(std::get<0>(parameters.own)));
  Result result{};
  for_each_law(parameters, [&]<class Law>(const auto& own, LawName name) {
    if (name == parameters.name) result = body.template operator()<Law>(own);
  });
  return result;
}

/// Whether the chosen law transmits tension: without, a free surface that is pulled at opens.
inline bool bears_tension(const LawParameters& parameters) {
  return with_chosen_law(parameters, []<class Law>(const auto& own) { return Law::bears_tension(own); });
}

/// The table of a law's keys: "law.drucker-prager".
template <class Law>
std::string table_of_law() {
  return "law." + std::string(Law::name);
}

/// Every key, once.
template <class Visit, class P>
void for_each_parameter(Visit&& visit, P& p) requires std::same_as<std::remove_const_t<P>, LawParameters> {
  static const std::string text = "constitutive law of the grains. " + Laws::text();
  visit(Parameter{"law.name", {}, {}, text}, p.name);
  for_each_law(p, [&]<class Law>(auto& own, LawName name) {
    auto chosen = only_if(where("law.name", p.name, name), visit);
    auto in_own_table = in_table(table_of_law<Law>(), chosen);
    Law::for_each_parameter(in_own_table, own);
  });
}

/// Contradictions between keys of the chosen law that are each valid by themselves; empty if there are none.
std::vector<Problem> check(const LawParameters& parameters);

/// \param grain_density rho_p, kg/m^3; \param grain_diameter D_p, m, for laws that depend on the rate
AnyLaw make_law(const LawParameters& parameters, double grain_density, double grain_diameter = fitted_diameter);

}  // namespace talus::granular

namespace talus {
template <>
inline constexpr auto choices<granular::LawName> = granular::Laws::names;
}  // namespace talus
