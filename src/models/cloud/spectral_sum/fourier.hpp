// SPDX-License-Identifier: Apache-2.0
/// Fourier transforms by FFTW. Plans are made without measurement (FFTW_ESTIMATE) and for one thread: they follow from
/// size, alignment and processor alone, and so do the bits. Planning is serialised; plans may be executed by several
/// threads at once, each on arrays of its own that are aligned as AlignedArray.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <memory>
#include <new>

namespace talus::cloud {

/// Numbers aligned to 64 bytes; 0 in a new array.
template <class T>
class AlignedArray {
 public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t count)
      : data_(static_cast<T*>(::operator new(count * sizeof(T), alignment))), size_(count) {
    std::uninitialized_value_construct_n(data_.get(), count);
  }
  T* data() const { return data_.get(); }
  std::size_t size() const { return size_; }
  T& operator[](std::size_t n) const { return data_.get()[n]; }

 private:
  static constexpr std::align_val_t alignment{64};
  struct Release {
    void operator()(T* p) const { ::operator delete(p, alignment); }
  };
  std::unique_ptr<T, Release> data_;
  std::size_t size_ = 0;
};

/// A plan, without a factor: forth and back multiplies by the size.
template <class T>
class Transform {
 public:
  Transform() = default;
  /// Of a row of numbers, in place: size + 2 of them.
  static Transform to_spectrum(std::size_t size, T* row);
  static Transform from_spectrum(std::size_t size, T* row);
  /// Of `width` columns side by side, from one array to another: in place FFTW's estimate takes buffered plans, which
  /// allocate at each execution.
  static Transform of_columns(std::size_t size, std::size_t width, std::complex<T>* from, std::complex<T>* to,
                              bool backward);

  void to_complex(T* row) const;
  void to_real(T* row) const;
  void of_complex(std::complex<T>* from, std::complex<T>* to) const;  ///< `from` is kept

 private:
  struct Release {
    void operator()(void* plan) const;
  };
  explicit Transform(void* plan) : plan_(plan) {}
  std::unique_ptr<void, Release> plan_;
};

/// In place, the cosine or (odd) sine transforms along every direction of the part, a quarter or an octant, of a
/// function on a doubled grid in which no coordinate is negative: what its Fourier transform is, up to -i for each odd
/// direction. Even: from the middle to the seam, both included; odd: both, where the function is 0, left out; of one
/// number: none. \param count of numbers along each direction, those along the first following each other
void transform_part(double* part, const std::array<std::size_t, 3>& count, const std::array<bool, 3>& odd);

}  // namespace talus::cloud
