// SPDX-License-Identifier: Apache-2.0
#include "fuzz/targets.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "app/continuum/bed_file.hpp"
#include "app/law/law_case.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "base/unit.hpp"
#include "io/case_file.hpp"
#include "io/parameter_reader.hpp"
#include "io/parameter_writer.hpp"
#include "io/points_csv.hpp"
#include "io/series.hpp"
#include "io/stl.hpp"
#include "models/cloud/model.hpp"
#include "models/continuum/setup/bed.hpp"
#include "models/continuum/setup/forecast.hpp"
#include "numerics/surface/surface_faults.hpp"
#include "run/run_parameters.hpp"

namespace talus::fuzz {

namespace {

void demand(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

/// Runs a reader; the faults that it may report must be fit for a terminal.
template <class Body>
void take(Body&& body) {
  const auto fit = [](std::string_view said) {
    return std::none_of(said.begin(), said.end(),
                        [](char c) { return (c >= 0 && c < 0x20 && c != '\n') || c == 0x7f; });
  };
  try {
    body();
  } catch (const InputError& error) {
    demand(!error.problems().empty(), "an InputError has problems");
    demand(fit(error.what()), "messages have no control characters");
  } catch (const FileError& error) {
    demand(fit(error.what()), "messages have no control characters");
  }
}

/// A file in memory with a name that readers can open.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("fuzz", 0)) { demand(descriptor_ >= 0, "there is memory for a file"); }
  std::string hold(std::string_view content) const {
    demand(ftruncate(descriptor_, 0) == 0, "a file is emptied");
    demand(pwrite(descriptor_, content.data(), content.size(), 0) == static_cast<ssize_t>(content.size()),
           "a file is filled");
    return "/proc/self/fd/" + std::to_string(descriptor_);
  }

 private:
  int descriptor_;
};

template <class Body>
void take_file(std::string_view content, Body&& body) {
  static const MemoryFile file;
  const std::string path = file.hold(content);
  take([&] { body(path); });
}

/// What a case means does not change when it is written out, resolved, and read again.
template <class P>
void expect_same_when_read_back(const run::RunParameters& run, const P& p, P again) {
  ParameterList list;
  run::for_each_parameter(list, run);
  for_each_parameter(list, p);
  const CaseFile file = CaseFile::from_text(resolved_case(list), "resolved.toml");
  run::RunParameters run_again;
  ParameterReader reader(file);
  run::for_each_parameter(reader, run_again);
  for_each_parameter(reader, again);
  reader.finish();
  ParameterList list_again;
  run::for_each_parameter(list_again, run_again);
  for_each_parameter(list_again, again);
  demand(fingerprint(list) == fingerprint(list_again), "a resolved case reads back to itself");
}

void read_cloud(const CaseFile& file) {
  cloud::Parameters p;
  run::RunParameters run;
  ParameterReader reader(file);
  run::for_each_parameter(reader, run);
  cloud::for_each_parameter(reader, p);
  reader.check(cloud::check(p));
  reader.finish();
  if (auto problem = cloud::check_steps(p, run.end)) throw InputError({*problem});
  const cloud::Forecast f = cloud::forecast(p, run.end, static_cast<double>(p.particles.count));
  demand(f.steps > 0 && f.evaluations >= f.steps && f.evaluations < 1e18, "a forecast is a number");
  expect_same_when_read_back(run, p, cloud::Parameters{});
}

void read_continuum(const CaseFile& file) {
  continuum::Parameters p;
  run::RunParameters run;
  p.plates.resize(std::min<std::size_t>(file.tables("plates"), max_inner_walls + 1));
  ParameterReader reader(file);
  run::for_each_parameter(reader, run);
  continuum::for_each_parameter(reader, p);
  reader.check(continuum::check(p));
  reader.finish();
  reader.check(continuum::check_steps(continuum::Setup(p), run.end));
  reader.throw_problems();
  if (continuum::lattice_of(p).positions() > 1e4) return;  // counting them takes its time
  const continuum::Forecast f = continuum::forecast(continuum::Setup(p), run.end);
  demand(f.flow_steps > 0 && f.settling_steps >= 0 && f.flow_steps + f.settling_steps < 1e13, "a forecast is a number");
  continuum::Parameters again;
  again.plates.resize(p.plates.size());
  if (p.plates.empty()) expect_same_when_read_back(run, p, again);
}

void read_by_both(const CaseFile& file) {
  take([&] { read_cloud(file); });
  take([&] { read_continuum(file); });
  take([&] { app::read_law_case(file); });
}

constexpr std::string_view small_case = R"(model = "cloud"
[particles]
shape = "circle"
count = 60
size = "60 mm"
radius = "5 mm"
density = "20 kg/m3"
[slope]
angle = "45 deg"
[run]
end = "1 ms"
)";

bool is_writable(const Dimension& d) {
  return std::max({std::abs(d.length), std::abs(d.mass), std::abs(d.time), std::abs(d.angle)}) <= 9;
}

}  // namespace

void read_case(std::string_view text) {
  take([&] { read_by_both(CaseFile::from_text(text, "case.toml")); });
}

void read_setting(std::string_view assignment) {
  take([&] {
    CaseFile file = CaseFile::from_text(small_case, "case.toml");
    file.set(assignment);
    read_by_both(file);
  });
}

void read_unit(std::string_view text) {
  std::string why;
  const auto quantity = parse_quantity(text, &why);
  demand(quantity || !why.empty(), "a refusal has a reason");
  const std::string shown = printable(text);
  demand(printable(shown) == shown, "what is printable stays so");
  if (!quantity || !is_writable(quantity->dimension)) return;
  const std::string written = format_quantity(quantity->value, unit_name(quantity->dimension));
  const auto again = parse_quantity(written);
  demand(again && again->value == quantity->value && again->dimension == quantity->dimension,
         "a quantity reads back to itself");
}

void read_points(std::string_view content) {
  take_file(content, [](const std::string& path) { read_points_csv(path); });
}

void read_series_file(std::string_view content) {
  take_file(content, [](const std::string& path) { read_series(path); });
}

void read_path_file(std::string_view content) {
  take_file(content, [](const std::string& path) { app::read_path(path); });
}

void read_stl_file(std::string_view content) {
  take_file(content, [](const std::string& path) {
    const std::vector<Triangle> triangles = read_stl(path);
    demand(!triangles.empty(), "a file that is accepted holds triangles");
    for (const SurfaceFault& fault : faults_of(triangles, true)) {
      demand(fault.triangle < triangles.size() && fault.other.value_or(0) < triangles.size(),
             "a fault is one of the file's triangles");
      demand(!text_of(fault.kind).empty(), "a fault has a name");
    }
  });
}

void read_bed_file(std::string_view content) {
  take_file(content, [](const std::string& path) {
    const continuum::GivenBed bed = app::read_bed(path);
    const std::size_t count = bed.position.size();
    demand(bed.lines.size() == count || bed.lines.empty(), "every particle has its line");
    demand(bed.velocity.empty() || bed.velocity.size() == count, "every particle has a velocity, or none");
    demand(bed.density.empty() || bed.density.size() == count, "every particle has a density, or none");
    continuum::Parameters p;
    p.box.width = p.box.depth = p.box.height = 1;
    p.bed.spacing = 1e-3;
    p.bed.file = path;
    p.bed.given = std::make_shared<continuum::GivenBed>(bed);
    const std::vector<Problem> problems = continuum::check_given_bed(p);
    demand(count > 0 || !problems.empty(), "a file without particles is no bed");
    for (const Problem& problem : problems) demand(!problem.what.empty(), "a problem says what is wrong");
  });
}

}  // namespace talus::fuzz
