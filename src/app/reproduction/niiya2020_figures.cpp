// SPDX-License-Identifier: Apache-2.0
#include "app/reproduction/niiya2020_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "app/reproduction/niiya2020_curves.hpp"
#include "app/reproduction/niiya2020_heads.hpp"
#include "app/reproduction/niiya2020_snapshots.hpp"
#include "io/figure/figure.hpp"

namespace talus::app {

namespace {

using namespace figure;

constexpr double page_width = 720;
constexpr double end = 1e9;  // later than any snapshot: the last one

/// A panel and its part of the caption.
struct Part {
  Panel panel;
  std::string text;
  bool wide = false;  ///< a row of its own
};

/// "20 members", "19 to 20 members" if some have failed.
std::string members_of(const Radii& radii) {
  const auto [fewest, most] = std::minmax_element(
      radii.begin(), radii.end(), [](const auto* a, const auto* b) { return a->runs.size() < b->runs.size(); });
  const std::size_t low = (*fewest)->runs.size(), high = (*most)->runs.size();
  if (high == 1) return "one member";
  return low == high ? fmt::format("{} members", high) : fmt::format("{} to {} members", low, high);
}

std::string spread_of(const Radii& radii) {
  return "Mean and standard deviation of " + members_of(radii) + " of each radius.";
}

ParticlePicture without_legend(ParticlePicture picture) {
  if (auto* by_category = std::get_if<ByCategory>(&picture.colouring))
    for (Category& category : by_category->categories) category.name.clear();
  return picture;
}

Chart with_aspect(Chart chart, double aspect) {
  chart.aspect = aspect;
  return chart;
}

/// The figures as they are described, and the particles that they look at.
class Album {
 public:
  explicit Album(const std::vector<AvalancheEnsemble>& ensembles)
      : circles_(radii_of(ensembles, "circle")),
        rectangles_(radii_of(ensembles, "rectangle")),
        triangles_(radii_of(ensembles, "triangle")) {}

  void describe() {
    if (circles_.empty() && rectangles_.empty() && triangles_.empty()) return;
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
    if (!circles_.empty() || !triangles_.empty()) motions();
  }

  std::vector<FigureOfStudy> draw(const std::filesystem::path& folder) const {
    std::filesystem::create_directories(folder);
    std::vector<FigureOfStudy> drawn;
    for (const auto& [name, title, caption, figure] : pages_) {
      drawn.push_back({folder / name, title, caption});
      write_png(figure, drawn.back().path);
    }
    return drawn;
  }

 private:
  struct Page {
    std::string name, title, caption;
    Figure figure;
  };

  MemberSnapshots& particles(const Radii& radii) { return members_.emplace_back(*radii.back()); }

  /// Panels two by two, wide ones in rows of their own. \param note the end of the caption
  void add(const std::string& name, const std::string& title, std::vector<Part> parts, const std::string& note) {
    Page page{name, title, {}, {}};
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const std::string letter = parts.size() > 1 ? fmt::format("({:c}) ", static_cast<char>('a' + i)) : "";
      page.caption += fmt::format("{}{}{} ", letter, parts[i].text, i + 1 < parts.size() ? ";" : ".");
    }
    page.caption += note;
    for (std::size_t i = 0; i < parts.size(); i += static_cast<std::size_t>(page.figure.rows.back()))
      page.figure.rows.push_back(parts[i].wide || parts.size() == 1 ? 1 : 2);
    for (Part& part : parts) page.figure.panels.push_back(std::move(part.panel));
    page.figure.width = page_width;
    pages_.push_back(std::move(page));
  }

  std::string one_run(const Radii& radii) const {
    return fmt::format("Particles: one run with *a*<sub>p</sub> = {}.", radii.back()->radius);
  }

  void initial_shapes() {
    std::vector<Part> parts;
    std::string left_out;
    if (!circles_.empty()) parts.push_back({particles(circles_).circle_at_start(), "circle, from above"});
    if (!triangles_.empty())
      parts.push_back({particles(triangles_).triangle_at_start(), "triangle, from the side: a heap behind a gate"});
    if (!rectangles_.empty())
      parts.push_back({particles(rectangles_).rectangle_at_start(),
                       "rectangle, from above; the printed *W* is half its width", true});
    if (circles_.empty()) left_out += " Figures 4, 5, 8 and 9 (circle)";
    if (rectangles_.empty()) left_out += fmt::format("{} Figure 6 (rectangle)", left_out.empty() ? "" : ",");
    if (triangles_.empty()) left_out += fmt::format("{} Figures 7 and 11 (triangle)", left_out.empty() ? "" : ",");
    add("figure_03.png", "As Figure 3: the shapes at the start", std::move(parts),
        "Lengths in particle radii, the slope falls along *x*." +
            (left_out.empty() ? "" : " Left out for want of finished runs:" + left_out + "."));
    pages_.back().figure.width = 0.82 * page_width;  // 6000 discs make a large file
  }

  void circle() {
    MemberSnapshots& member = particles(circles_);
    add("figure_04.png", "As Figure 4: a disc gathers into one head",
        {{without_legend(member.front_with_heads(0)), "the start"},
         {without_legend(member.front_with_heads(7.96)), "the front overtakes"},
         {without_legend(member.front_with_heads(19.9)), "a crescent"},
         {member.front_with_heads(end), "the end of the run"},
         {without_legend(member.with_heads(end, view_xy)), "the same with all that is left behind", true}},
        "Blue: the head by *n'* (Eq. 11b), which at the start is nearly all. " + one_run(circles_));
    add("figure_05.png", "As Figure 5: the circle's front speed, and velocities relative to the front",
        {{front_speeds(circles_, 30, 70), "front speed over the Stokes speed *v*<sub>s</sub>"},
         {member.motion_in_head(19.9),
          "velocities less the front's, in the head and behind it, of one run with "
          "*a*<sub>p</sub> = " +
              circles_.back()->radius}},
        spread_of(circles_));
  }

  void rectangle() {
    MemberSnapshots& member = particles(rectangles_);
    std::vector<ParticlePicture> bands{without_legend(member.at(0, view_downhill)),
                                       without_legend(member.with_heads(7.96, view_downhill))};
    share_scale(bands);
    add("figure_06.png", "As Figure 6: a straight front breaks into heads",
        {{bands[0], "the start", true},
         {bands[1], "the front gathers and becomes wavy", true},
         {member.with_heads(end, view_downhill), "heads at the end of the run (blue)"},
         {front_speeds(rectangles_, 20, 28), "front speed over *v*<sub>s</sub>"}},
        one_run(rectangles_) + " " + spread_of(rectangles_));
  }

  void triangle() {
    MemberSnapshots& member = particles(triangles_);
    add("figure_07.png", "As Figure 7: head and tail",
        {{member.relative_speed(15.9), "the front coloured by the velocity along the slope less the front's", true},
         {member.relative_speed(end), "the same at the end of the run", true},
         {front_speeds(triangles_, 0, 0), "front speed over *v*<sub>s</sub>"},
         {thickness_ratios(triangles_), "thickness of the head over the median of the rear half"}},
        one_run(triangles_) + " " + spread_of(triangles_));
  }

  void heads() {
    MemberSnapshots& member = particles(circles_);
    add("figure_08.png", "As Figure 8: the head by *n* and by *n'*",
        {{member.head_by(HeadRule::Measure::direct, 19.9), "the grains that Eq. 11a takes for heads"},
         {member.head_by(HeadRule::Measure::indirect, 19.9),
          "those of Eq. 11b, with the width and the layer thickness of the head and the four grains they are measured "
          "between"}},
        one_run(circles_));
  }

  void head_size_in_time() {
    add("figure_09.png", "As Figure 9: the circle's head in time",
        {{head_particles(circles_), "number of its grains"},
         {head_sizes(circles_), "its width and layer thickness"},
         {head_aspect_ratios(circles_), "width over thickness, mean of the members' ratios"},
         {front_speed_of_head(circles_), "front speed against the number of grains"}},
        spread_of(circles_));
  }

  void head_size_varies() {
    std::vector<Part> parts;
    std::string note;
    if (!circles_.empty()) parts.push_back({width_against_thickness(circles_), "width against thickness, circle"});
    if (!rectangles_.empty()) {
      parts.push_back({width_distributions(rectangles_),
                       "widths of the rectangle's heads at the end, and the Gaussian nearest to those of " +
                           rectangles_.back()->radius});
      if (rectangles_.size() > 1)
        parts.push_back({width_against_radius(rectangles_), "their mean and standard deviation against the radius"});
      else
        note = "Left out: width against radius, which takes two radii. ";
      parts.push_back({head_counts(rectangles_), "their number, beside the printed one"});
    }
    note += spread_of(circles_.empty() ? rectangles_ : circles_);
    if (circles_.empty()) note += " Left out for want of finished runs: the circle.";
    if (rectangles_.empty()) note += " Left out for want of finished runs: the rectangle.";
    add("figure_10.png", "As Figure 10: how the sizes of heads vary", std::move(parts), note);
  }

  void frontal_angle() {
    MemberSnapshots& member = particles(triangles_);
    add("figure_11.png", "As Figure 11: the frontal angle",
        {{without_legend(member.frontal_surface(15.9)), "the grains of the front's surface and the line through them"},
         {member.frontal_surface(end), "the same at the end of the run"},
         {with_aspect(frontal_angles(triangles_), 0.4), "angle between the slope and the line", true}},
        one_run(triangles_) + " " + spread_of(triangles_));
  }

  void motions() {
    std::vector<Part> parts;
    if (!circles_.empty()) {
      parts.push_back({head_curls(circles_), "curl of the velocity in the halves of the circle's head"});
      parts.push_back({head_motions(circles_), "its rear and its front, relative to the front"});
    }
    if (!triangles_.empty()) {
      parts.push_back(
          {layer_motions(triangles_),
           "upper third and lower part of the triangle's head (of the first, values below the axis are not shown)"});
      parts.push_back({tail_motions(triangles_), "the triangle's tail"});
    }
    add("figure_motions.png", "Beside Figures 5b and 7a: motion relative to the front in time", std::move(parts),
        spread_of(circles_.empty() ? triangles_ : circles_));
  }

  Radii circles_, rectangles_, triangles_;
  std::deque<MemberSnapshots> members_;  // their addresses stay
  std::vector<Page> pages_;
};

}  // namespace

std::vector<FigureOfStudy> draw_niiya2020(const std::vector<AvalancheEnsemble>& ensembles,
                                          const std::filesystem::path& folder) {
  Album album(ensembles);
  album.describe();
  return album.draw(folder);
}

}  // namespace talus::app
