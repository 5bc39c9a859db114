// SPDX-License-Identifier: Apache-2.0
/// The whole of a snapshot that holds one sector.
#pragma once

#include "numerics/snapshot.hpp"

namespace talus {

/// The particles of all copies, copy by copy: positions, vectors and tensors (six columns NAME_xx, NAME_yy, NAME_zz,
/// NAME_xy, NAME_yz, NAME_zx) turned about the axis. A particle that has passed a face of the sector goes on in the
/// next copy: its identity there is that which it had here. \pre part.copies \throws std::invalid_argument if the
/// copies are too few or too many (Sector)
PointSet whole_of(const Snapshot& part);

}  // namespace talus
