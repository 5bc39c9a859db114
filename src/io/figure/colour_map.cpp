// SPDX-License-Identifier: Apache-2.0
/// Viridis stands here as 33 equally spaced colours, fitted by least squares so that straight lines between them follow
/// the published table. Source: van der Walt & Smith, "mpl-colormaps" (2015).
#include "io/figure/colour_map.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace talus::figure {

namespace {

using Table = std::array<unsigned, 33>;

constexpr Table viridis_table = {
    0x440154, 0x470d60, 0x48186a, 0x482374, 0x472d7b, 0x453681, 0x424086, 0x3f4989, 0x3b528b, 0x375a8d, 0x33638d,
    0x2f6a8e, 0x2c728e, 0x297a8e, 0x26818e, 0x23898e, 0x21908d, 0x1f988b, 0x1e9f88, 0x21a685, 0x27ae80, 0x31b57b,
    0x3dbc74, 0x4cc26c, 0x5cc963, 0x6ece58, 0x81d44c, 0x96d840, 0xabdc32, 0xc0df24, 0xd5e219, 0xeae519, 0xfde725};

}  // namespace

Colour colour_at(double t) {
  t = t > 0.0 ? std::min(t, 1.0) : 0.0;
  const double place = t * static_cast<double>(viridis_table.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), viridis_table.size() - 2);
  return mix(rgb(viridis_table[below]), rgb(viridis_table[below + 1]), place - static_cast<double>(below));
}

}  // namespace talus::figure
