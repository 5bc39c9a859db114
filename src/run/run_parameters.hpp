// SPDX-License-Identifier: Apache-2.0
/// What a case says about the run itself, whatever the model.
#pragma once

#include <string>

#include "base/parameter.hpp"

namespace talus::run {

struct RunParameters {
  std::string model;
  std::string title;
  double end = 0;
  double snapshots = 0;
  double series = 0;
  bool pictures = true;
  bool report = true;
  double checkpoint_interval = 30;
};

template <class Visit, class P>
void for_each_parameter(Visit&& visit, P& p) {
  visit(Parameter{"model", {}, {}, "which model: cloud, continuum or air", true}, p.model);
  visit(Parameter{"title", {}, {}, "one line for pictures and reports"}, p.title);
  visit(
      Parameter{
          "run.end", dimension::time, above(0),
          "simulated time; the run ends with the first step past it. Of a model with a gate counted from its opening",
          true},
      p.end);
  visit(Parameter{"output.snapshots", dimension::time, at_least(0),
                  "simulated time between snapshots: each is taken at the end of the first step past its time; 0: a "
                  "twentieth of run.end"},
        p.snapshots);
  visit(Parameter{"output.series", dimension::time, at_least(0),
                  "simulated time between rows of series.csv: each belongs to the first step past its time; 0: one row "
                  "per step"},
        p.series);
  visit(Parameter{"output.pictures", {}, {}, "whether pictures are drawn at the end"}, p.pictures);
  visit(Parameter{"output.report", {}, {}, "whether report.html is written at the end"}, p.report);
  visit(Parameter{"output.checkpoint_interval", dimension::time, above(0), "wall time between checkpoints"},
        p.checkpoint_interval);
}

}  // namespace talus::run
