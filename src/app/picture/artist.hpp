// SPDX-License-Identifier: Apache-2.0
/// Pictures of one or several runs that can be compared: the same window, the same colours, the same arrows in every
/// panel and in every frame of a movie.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/picture/frame.hpp"
#include "io/figure/figure.hpp"

namespace talus::app {

struct PictureStyle {
  Shown shown = {};
  std::optional<std::pair<double, double>> range = {};  ///< of the colours, in `unit`; none: from what was looked at
  std::string unit = {};                                ///< of the colours; empty: SI
  std::string view = {};                                ///< xz, xy, yz or oblique; empty: that of the case
  std::string title = {};
  double width = 0;  ///< pixels; 0: two for each unit of the page
};

/// The views that a style may name.
inline constexpr std::string_view picture_views[] = {"xz", "xy", "yz", "oblique"};

class Artist {
 public:
  /// \param runs must outlive it; \param names of the runs, shown in the panels of several
  Artist(const std::vector<RunFrames>& runs, std::vector<std::string> names, PictureStyle style);

  /// Everything that shall be drawn is looked at first. The colours then reach from the lowest first to the highest
  /// last hundredth of the values of a frame: a single particle does not take the range from the others.
  /// \throws InputError if the unit is none of the field's
  void look_at(std::size_t run, const Frame& frame);

  /// How many panels stand well in a row: one of long flat windows, six of high ones.
  int panels_in_a_row() const;

  struct Panel {
    std::size_t run = 0;
    const Frame* frame = nullptr;
  };
  /// \param columns panels in a row. The figure looks at the frames.
  figure::Figure figure(const std::vector<Panel>& panels, int columns) const;

 private:
  figure::View view_of(const Scene& scene) const;
  figure::Window window(std::size_t run) const;
  double aspect() const;  ///< height over width of the plots
  figure::ParticlePicture picture(const Panel& panel, bool alone) const;

  const std::vector<RunFrames>& runs_;
  std::vector<std::string> names_;
  PictureStyle style_;
  std::vector<figure::Window> windows_;  ///< of each run, from what was looked at
  double low_, high_;                    ///< of the colours, SI
  double usual_arrow_ = 0;               ///< the largest that nearly all arrows of a frame stay below
  std::string arrow_unit_ = {};
  figure::Unit unit_ = {};
};

}  // namespace talus::app
