// SPDX-License-Identifier: Apache-2.0
#include "app/reproduction/niiya2020_figures.hpp"

#include <deque>
#include <utility>

#include "app/reproduction/niiya2020_curves.hpp"
#include "app/reproduction/niiya2020_snapshots.hpp"
#include "io/figure/figure.hpp"

namespace talus::app {

namespace {

using namespace figure;

constexpr double end = 1e9;  // later than any snapshot: the last one

/// The figures as they are described, and the particles that they look at.
class Album {
 public:
  explicit Album(const std::vector<StudiedEnsemble>& ensembles)
      : circles_(radii_of(ensembles, "circle")),
        rectangles_(radii_of(ensembles, "rectangle")),
        triangles_(radii_of(ensembles, "triangle")) {}

  void describe() {
    initial_shapes();
    if (!circles_.empty()) circle();
    if (!rectangles_.empty()) rectangle();
    if (!triangles_.empty()) triangle();
    if (!circles_.empty()) {
      heads();
      head_size_in_time();
    }
    if (!circles_.empty() || !rectangles_.empty()) head_size_varies();
    if (!triangles_.empty()) frontal_angle();
  }

  std::vector<FigureOfStudy> draw(const std::filesystem::path& folder) const {
    std::filesystem::create_directories(folder);
    std::vector<FigureOfStudy> drawn;
    for (const auto& [name, caption, figure] : pages_) {
      drawn.push_back({folder / name, caption});
      write_png(figure, drawn.back().path);
    }
    return drawn;
  }

 private:
  struct Page {
    std::string name, caption;
    Figure figure;
  };

  MemberSnapshots& particles(const Radii& radii) { return members_.emplace_back(*radii.back()); }

  void add(const std::string& name, const std::string& caption, std::vector<Panel> panels, int columns) {
    pages_.push_back({name, caption, {.panels = std::move(panels), .columns = columns}});
  }

  void initial_shapes() {
    std::vector<Panel> panels;
    if (!circles_.empty()) panels.emplace_back(particles(circles_).at(0, view_xy));
    if (!rectangles_.empty()) panels.emplace_back(particles(rectangles_).at(0, view_downhill));
    if (!triangles_.empty()) {
      ParticlePicture picture = particles(triangles_).at(0, view_xz);
      picture.slope = true;
      panels.emplace_back(std::move(picture));
    }
    if (!panels.empty())
      add("figure_03.png",
          "As Figure 3: the shapes at the start; circle and rectangle from above, triangle from the side",
          std::move(panels), 3);
  }

  void circle() {
    MemberSnapshots& member = particles(circles_);
    std::vector<ParticlePicture> frames;
    for (const double t : {0.0, 7.96, 19.9, 39.8}) frames.push_back(member.with_heads(t, view_xy));
    share_scale(frames);
    add("figure_04.png", "As Figure 4: a disc gathers into one head (blue) that sheds its grains",
        {frames.begin(), frames.end()}, 2);
    add("figure_05.png",
        "As Figure 5: front speed of the circle, mean and standard deviation over the members; velocities relative to "
        "the front in the head",
        {front_speeds(circles_, 30, 70), member.motion_in_head(19.9)}, 2);
  }

  void rectangle() {
    MemberSnapshots& member = particles(rectangles_);
    std::vector<ParticlePicture> frames;
    for (const double t : {0.0, 7.96, 39.8}) frames.push_back(member.with_heads(t, view_downhill));
    std::vector<Panel> panels(frames.begin(), frames.end());
    panels.emplace_back(front_speeds(rectangles_, 20, 28));
    add("figure_06.png", "As Figure 6: a straight front breaks into heads (blue); its speed", std::move(panels), 2);
  }

  void triangle() {
    MemberSnapshots& member = particles(triangles_);
    add("figure_07.png",
        "As Figure 7: head and tail, coloured by the speed along the slope relative to the front; the front's speed",
        {member.relative_speed(15.9), member.relative_speed(end), front_speeds(triangles_, 0, 0)}, 2);
  }

  void heads() {
    MemberSnapshots& member = particles(circles_);
    add("figure_08.png", "As Figure 8: the head by n and by n', with its width and thickness",
        {member.head_by(HeadRule::Measure::direct, 19.9), member.head_by(HeadRule::Measure::indirect, 19.9)}, 2);
  }

  void head_size_in_time() {
    add("figure_09.png",
        "As Figure 9: grains, width and thickness of the circle's head; front speed against its grains",
        {head_particles(circles_), head_sizes(circles_), front_speed_of_head(circles_)}, 3);
  }

  void head_size_varies() {
    std::vector<Panel> panels;
    if (!circles_.empty()) panels.emplace_back(width_against_thickness(circles_));
    if (!rectangles_.empty()) {
      panels.emplace_back(width_distributions(rectangles_));
      panels.emplace_back(width_against_radius(rectangles_));
    }
    add("figure_10.png",
        "As Figure 10: width against thickness of the circle's head; widths of the rectangle's heads at the end; their "
        "mean against the radius",
        std::move(panels), 3);
  }

  void frontal_angle() {
    MemberSnapshots& member = particles(triangles_);
    add("figure_11.png", "As Figure 11: the surface of the triangle's front and the line through it; the angle in time",
        {member.frontal_surface(15.9), member.frontal_surface(end), frontal_angles(triangles_)}, 3);
  }

  Radii circles_, rectangles_, triangles_;
  std::deque<MemberSnapshots> members_;  // their addresses stay
  std::vector<Page> pages_;
};

}  // namespace

std::vector<FigureOfStudy> draw_niiya2020(const std::vector<StudiedEnsemble>& ensembles,
                                          const std::filesystem::path& folder) {
  Album album(ensembles);
  album.describe();
  return album.draw(folder);
}

}  // namespace talus::app
