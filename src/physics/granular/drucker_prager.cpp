// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/drucker_prager.hpp"

#include <cmath>
#include <stdexcept>

namespace talus::granular {

DruckerPrager::DruckerPrager(const Parameters& parameters, double grain_density)
    : parameters_(parameters),
      memory_(parameters.contact),
      shear_(shear_table(parameters.fits.functions())),
      inverse_grain_density_(1 / grain_density) {
  const Fits& fits = parameters.fits;
  if (!(fits.largest_deviator <= largest_fitted_strain))
    throw std::invalid_argument("the largest deviator lies beyond the range of the fits");
  const FittedFunctions& functions = fits.functions();
  const double lambda = fits.scale * functions.a2.piece[0].c0;
  two_g_ = fits.scale * (functions.a1.piece[0].c0 - functions.a2.piece[0].c0);
  inverse_two_g_ = 1 / two_g_;
  bulk_ = lambda + two_g_ / 3;
}

double DruckerPrager::sound_speed(double density) const {
  return std::sqrt((bulk_ + 2.0 / 3.0 * two_g_) / density);
}

}  // namespace talus::granular
