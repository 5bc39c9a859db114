// SPDX-License-Identifier: Apache-2.0
#include "ranks/petsc/zoltan.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <zoltan.h>

#include <cstdio>
#include <stdexcept>

namespace talus {

namespace {

/// Zoltan greets on stdout.
class Silence {
 public:
  Silence() : kept_(dup(STDOUT_FILENO)) {
    std::fflush(stdout);
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere >= 0) dup2(nowhere, STDOUT_FILENO), close(nowhere);
  }
  ~Silence() {
    std::fflush(stdout);
    if (kept_ >= 0) dup2(kept_, STDOUT_FILENO), close(kept_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  int kept_;
};

/// Cuts are a little aslant: one along a lattice would put whole layers of it on one side. Rises with every coordinate.
Vector3 aslant(const Vector3& x) {
  constexpr double a = 0.011, b = 0.007;
  return {x.x + a * x.y + b * x.z, x.y + a * x.z + b * x.x, x.z + a * x.x + b * x.y};
}

/// What Zoltan asks for while it cuts.
struct Points {
  std::span<const Vector3> place;
  std::span<const double> weight;
};

int count_of(void* points, int* error) {
  *error = ZOLTAN_OK;
  return static_cast<int>(static_cast<const Points*>(points)->place.size());
}

void list_of(void* points, int, int, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR local, int, float* weight, int* error) {
  *error = ZOLTAN_OK;
  const auto& given = *static_cast<const Points*>(points);
  for (std::size_t n = 0; n < given.place.size(); ++n) {
    global[n] = local[n] = static_cast<ZOLTAN_ID_TYPE>(n);
    weight[n] = static_cast<float>(given.weight[n]);
  }
}

int dimensions(void*, int* error) {
  *error = ZOLTAN_OK;
  return 3;
}

void places_of(void* points, int, int, int count, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local, int, double* place, int* error) {
  *error = ZOLTAN_OK;
  const auto& given = *static_cast<const Points*>(points);
  for (int n = 0; n < count; ++n) {
    const Vector3 x = aslant(given.place[local[n]]);
    for (int axis = 0; axis < 3; ++axis) place[3 * n + axis] = x[axis];
  }
}

void check(int code, const char* what) {
  if (code != ZOLTAN_OK && code != ZOLTAN_WARN) throw std::runtime_error(std::string("Zoltan cannot ") + what);
}

class RecursiveBisection final : public Partition {
 public:
  explicit RecursiveBisection(MPI_Comm communicator) {
    const Silence silence;
    float version = 0;
    check(Zoltan_Initialize(0, nullptr, &version), "start");
    zoltan_ = Zoltan_Create(communicator);
    MPI_Comm_size(communicator, &size_);
    // Cuts are kept: they say whose any place is.
    constexpr const char* settings[][2] = {
        {"LB_METHOD", "RCB"},     {"KEEP_CUTS", "1"},         {"OBJ_WEIGHT_DIM", "1"},  {"DEBUG_LEVEL", "0"},
        {"RETURN_LISTS", "NONE"}, {"IMBALANCE_TOL", "1.005"}, {"NUM_GID_ENTRIES", "1"}, {"NUM_LID_ENTRIES", "1"}};
    for (const auto& [key, value] : settings) check(Zoltan_Set_Param(zoltan_, key, value), "be set");
    Zoltan_Set_Num_Obj_Fn(zoltan_, count_of, &points_);
    Zoltan_Set_Obj_List_Fn(zoltan_, list_of, &points_);
    Zoltan_Set_Num_Geom_Fn(zoltan_, dimensions, nullptr);
    Zoltan_Set_Geom_Multi_Fn(zoltan_, places_of, &points_);
  }
  ~RecursiveBisection() override { Zoltan_Destroy(&zoltan_); }

  void cut(std::span<const Vector3> points, std::span<const double> weight) override {
    const Silence silence;
    points_ = {points, weight};
    int changes = 0, global = 0, local = 0, in = 0, out = 0;
    ZOLTAN_ID_PTR in_global = nullptr, in_local = nullptr, out_global = nullptr, out_local = nullptr;
    int *in_from = nullptr, *in_to = nullptr, *out_from = nullptr, *out_to = nullptr;
    check(Zoltan_LB_Partition(zoltan_, &changes, &global, &local, &in, &in_global, &in_local, &in_from, &in_to, &out,
                              &out_global, &out_local, &out_from, &out_to),
          "cut space into parts");
    points_ = {};
  }

  int rank_of(const Vector3& x) const override {
    const Vector3 at = aslant(x);
    double place[3] = {at.x, at.y, at.z};
    int rank = 0, part = 0;
    check(Zoltan_LB_Point_PP_Assign(zoltan_, place, &rank, &part), "say whose a place is");
    return rank;
  }

  void ranks_of(const Vector3& low, const Vector3& high, std::vector<int>& ranks) const override {
    int count = 0;
    ranks.resize(static_cast<std::size_t>(size_));
    const Vector3 from = aslant(low), to = aslant(high);
    check(Zoltan_LB_Box_Assign(zoltan_, from.x, from.y, from.z, to.x, to.y, to.z, ranks.data(), &count),
          "say whose a box is");
    ranks.resize(static_cast<std::size_t>(count));
  }

 private:
  Zoltan_Struct* zoltan_ = nullptr;
  int size_ = 1;
  Points points_;
};

}  // namespace

std::unique_ptr<Partition> recursive_bisection(MPI_Comm communicator) {
  return std::make_unique<RecursiveBisection>(communicator);
}

}  // namespace talus
