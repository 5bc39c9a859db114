// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/spectral_sum/fourier.hpp"

#include <fftw3.h>

#include <mutex>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace talus::cloud {

namespace {

// FFTW's functions under one name for both precisions.
template <class T>
struct Fftw;
#define TALUS_FFTW(T, prefix)                                               \
  template <>                                                               \
  struct Fftw<T> {                                                          \
    using Plan = prefix##_plan;                                             \
    using Complex = prefix##_complex;                                       \
    static constexpr auto plan_to_spectrum = prefix##_plan_dft_r2c_1d;      \
    static constexpr auto plan_from_spectrum = prefix##_plan_dft_c2r_1d;    \
    static constexpr auto plan_many = prefix##_plan_many_dft;               \
    static constexpr auto execute_to_spectrum = prefix##_execute_dft_r2c;   \
    static constexpr auto execute_from_spectrum = prefix##_execute_dft_c2r; \
    static constexpr auto execute_complex = prefix##_execute_dft;           \
    static constexpr auto destroy = prefix##_destroy_plan;                  \
  };
TALUS_FFTW(float, fftwf)
TALUS_FFTW(double, fftw)
#undef TALUS_FFTW

std::mutex& planner() {
  static std::mutex mutex;
  return mutex;
}

void* made(void* plan) {
  if (!plan) throw std::runtime_error("FFTW made no plan");
  return plan;
}

template <class T>
typename Fftw<T>::Complex* complex_of(T* numbers) {
  return reinterpret_cast<typename Fftw<T>::Complex*>(numbers);
}

template <class T>
typename Fftw<T>::Plan as_plan(void* plan) {
  return static_cast<typename Fftw<T>::Plan>(plan);
}

}  // namespace

template <class T>
void Transform<T>::Release::operator()(void* plan) const {
  const std::lock_guard lock(planner());
  Fftw<T>::destroy(as_plan<T>(plan));
}

template <class T>
Transform<T> Transform<T>::to_spectrum(std::size_t size, T* row) {
  const std::lock_guard lock(planner());
  return Transform(made(Fftw<T>::plan_to_spectrum(static_cast<int>(size), row, complex_of(row), FFTW_ESTIMATE)));
}

template <class T>
Transform<T> Transform<T>::from_spectrum(std::size_t size, T* row) {
  const std::lock_guard lock(planner());
  return Transform(made(Fftw<T>::plan_from_spectrum(static_cast<int>(size), complex_of(row), row, FFTW_ESTIMATE)));
}

template <class T>
Transform<T> Transform<T>::of_columns(std::size_t size, std::size_t width, std::complex<T>* from, std::complex<T>* to,
                                      bool backward) {
  const std::lock_guard lock(planner());
  const int n = static_cast<int>(size), count = static_cast<int>(width);
  return Transform(made(Fftw<T>::plan_many(1, &n, count, complex_of(reinterpret_cast<T*>(from)), nullptr, count, 1,
                                           complex_of(reinterpret_cast<T*>(to)), nullptr, count, 1,
                                           backward ? FFTW_BACKWARD : FFTW_FORWARD, FFTW_ESTIMATE)));
}

template <class T>
void Transform<T>::to_complex(T* row) const {
  Fftw<T>::execute_to_spectrum(as_plan<T>(plan_.get()), row, complex_of(row));
}

template <class T>
void Transform<T>::to_real(T* row) const {
  Fftw<T>::execute_from_spectrum(as_plan<T>(plan_.get()), complex_of(row), row);
}

template <class T>
void Transform<T>::of_complex(std::complex<T>* from, std::complex<T>* to) const {
  Fftw<T>::execute_complex(as_plan<T>(plan_.get()), complex_of(reinterpret_cast<T*>(from)),
                           complex_of(reinterpret_cast<T*>(to)));
}

template class Transform<float>;
template class Transform<double>;

void transform_part(double* part, const std::array<std::size_t, 3>& count, const std::array<bool, 3>& odd) {
  std::vector<int> size;
  std::vector<fftw_r2r_kind> kind;
  for (std::size_t k = 3; k-- > 0;) {
    if (count[k] == 1 && !odd[k]) continue;
    size.push_back(static_cast<int>(count[k]));
    kind.push_back(odd[k] ? FFTW_RODFT00 : FFTW_REDFT00);
  }
  fftw_plan plan = nullptr;
  {
    const std::lock_guard lock(planner());
    plan = fftw_plan_r2r(static_cast<int>(size.size()), size.data(), part, part, kind.data(), FFTW_ESTIMATE);
    made(plan);
  }
  fftw_execute(plan);
  const std::lock_guard lock(planner());
  fftw_destroy_plan(plan);
}

}  // namespace talus::cloud
