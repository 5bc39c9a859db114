// SPDX-License-Identifier: Apache-2.0
#include "ranks/petsc/petsc.hpp"

#include <petscsf.h>
#include <petscsys.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "ranks/petsc/zoltan.hpp"

namespace talus {

namespace {

void check(PetscErrorCode code, const char* what) {
  if (code != 0) throw std::runtime_error(std::string("PETSc cannot ") + what);
}

int as_int(std::size_t count) {
  if (count > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw std::runtime_error("a process sends more than 2^31 items at once");
  return static_cast<int>(count);
}

/// Some words of 8 bytes as one item of a message.
class Item {
 public:
  explicit Item(std::size_t words) {
    MPI_Type_contiguous(as_int(words), MPI_DOUBLE, &type_);
    MPI_Type_commit(&type_);
  }
  ~Item() { MPI_Type_free(&type_); }
  Item(const Item&) = delete;
  Item& operator=(const Item&) = delete;
  MPI_Datatype type() const { return type_; }

 private:
  MPI_Datatype type_{};
};

/// Every item received is a leaf of the star forest, and the item sent its root.
class StarForest final : public Plan {
 public:
  StarForest(PetscSF forest, std::size_t sent, std::size_t received) : Plan(sent, received), forest_(forest) {}
  ~StarForest() override { PetscSFDestroy(&forest_); }
  using Plan::exchange;
  void exchange(const void* items, std::size_t words, void* received) override {
    if (words == 0) return;
    const Item item(words);
    check(PetscSFBcastBegin(forest_, item.type(), items, received, MPI_REPLACE), "send");
    check(PetscSFBcastEnd(forest_, item.type(), items, received, MPI_REPLACE), "receive");
  }

 private:
  PetscSF forest_;
};

/// Who sends how many items to this process, and where they begin among those that it sends.
struct Sender {
  PetscMPIInt rank;
  int first, count;
};

std::vector<Sender> senders(MPI_Comm communicator, std::span<const std::size_t> counts) {
  std::vector<PetscMPIInt> to;
  std::vector<int> told;
  int first = 0;
  for (std::size_t r = 0; r < counts.size(); ++r) {
    if (counts[r] == 0) continue;
    to.push_back(static_cast<PetscMPIInt>(r));
    told.push_back(first);
    told.push_back(as_int(counts[r]));
    first += as_int(counts[r]);
  }
  MPI_Datatype two{};
  MPI_Type_contiguous(2, MPI_INT, &two);
  MPI_Type_commit(&two);
  PetscMPIInt heard_of = 0;
  PetscMPIInt* from = nullptr;
  int* heard = nullptr;
  check(PetscCommBuildTwoSided(communicator, 1, two, as_int(to.size()), to.data(), told.data(), &heard_of, &from,
                               static_cast<void*>(&heard)),
        "plan messages");
  MPI_Type_free(&two);
  std::vector<Sender> found;
  for (PetscMPIInt n = 0; n < heard_of; ++n) found.push_back({from[n], heard[2 * n], heard[2 * n + 1]});
  PetscFree(from);
  PetscFree(heard);
  std::sort(found.begin(), found.end(), [](const Sender& a, const Sender& b) { return a.rank < b.rank; });
  return found;
}

/// An entry of votes as it travels.
struct Vote {
  std::uint64_t is_sum;
  union {
    double least;
    std::uint64_t sum;
  };
};

/// As MPI_User_function has it.
void combine(void* in, void* in_out, int* count, MPI_Datatype*) {  // NOLINT(readability-non-const-parameter)
  const auto* const from = static_cast<const Vote*>(in);
  auto* const to = static_cast<Vote*>(in_out);
  for (int n = 0; n < *count; ++n) {
    if (to[n].is_sum)
      to[n].sum += from[n].sum;
    else if (from[n].least < to[n].least)
      to[n].least = from[n].least;
  }
}

class MpiProcesses final : public Ranks {
 public:
  MpiProcesses(int rank, int size) : Ranks(rank, size) {
    MPI_Type_contiguous(sizeof(Vote) / 8, MPI_UINT64_T, &vote_);
    MPI_Type_commit(&vote_);
    MPI_Op_create(combine, 1, &combine_);
  }
  ~MpiProcesses() override {
    MPI_Op_free(&combine_);
    MPI_Type_free(&vote_);
    PetscFinalize();
    MPI_Finalize();
  }

  void join(Votes& votes) const override {
    std::vector<Vote> told;
    for (const double v : votes.least) told.push_back({.is_sum = 0, .least = v});
    for (const double v : votes.largest) told.push_back({.is_sum = 0, .least = -v});
    for (const std::uint64_t v : votes.sum) told.push_back({.is_sum = 1, .sum = v});
    MPI_Allreduce(MPI_IN_PLACE, told.data(), as_int(told.size()), vote_, combine_, MPI_COMM_WORLD);
    const Vote* next = told.data();
    for (double& v : votes.least) v = (next++)->least;
    for (double& v : votes.largest) v = -(next++)->least;
    for (std::uint64_t& v : votes.sum) v = (next++)->sum;
  }

  void add_up(std::span<double> sums) const override {
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), as_int(sums.size()), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  }

  std::string gather(const std::string& own) const override {
    const int length = as_int(own.size());
    std::vector<int> lengths(static_cast<std::size_t>(size())), first(lengths.size());
    MPI_Allgather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, MPI_COMM_WORLD);
    std::exclusive_scan(lengths.begin(), lengths.end(), first.begin(), 0);
    std::string all(static_cast<std::size_t>(first.back() + lengths.back()), '\0');
    MPI_Allgatherv(own.data(), length, MPI_BYTE, all.data(), lengths.data(), first.data(), MPI_BYTE, MPI_COMM_WORLD);
    return all;
  }

  std::string gather_at_first(const std::string& own) const override {
    const int length = as_int(own.size());
    std::vector<int> lengths(is_first() ? static_cast<std::size_t>(size()) : 0), first(lengths.size());
    MPI_Gather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
    std::exclusive_scan(lengths.begin(), lengths.end(), first.begin(), 0);
    std::string all(is_first() ? static_cast<std::size_t>(first.back() + lengths.back()) : 0, '\0');
    MPI_Gatherv(own.data(), length, MPI_BYTE, all.data(), lengths.data(), first.data(), MPI_BYTE, 0, MPI_COMM_WORLD);
    return all;
  }

  void from_first(std::span<std::byte> bytes) const override {
    MPI_Bcast(bytes.data(), as_int(bytes.size()), MPI_BYTE, 0, MPI_COMM_WORLD);
  }

  std::unique_ptr<Plan> plan(std::span<const std::size_t> counts) const override {
    std::vector<PetscSFNode> roots;
    for (const Sender& sender : senders(MPI_COMM_WORLD, counts))
      for (int n = 0; n < sender.count; ++n) roots.push_back({sender.rank, sender.first + n});
    const std::size_t sent = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
    PetscSF forest = nullptr;
    check(PetscSFCreate(MPI_COMM_WORLD, &forest), "plan messages");
    check(PetscSFSetGraph(forest, as_int(sent), as_int(roots.size()), nullptr, PETSC_COPY_VALUES, roots.data(),
                          PETSC_COPY_VALUES),
          "plan messages");
    check(PetscSFSetUp(forest), "plan messages");
    return std::make_unique<StarForest>(forest, sent, roots.size());
  }

  std::unique_ptr<Partition> partition() const override { return recursive_bisection(MPI_COMM_WORLD); }

  int on_this_machine() const override {
    MPI_Comm machine{};
    int count = 1;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    MPI_Comm_size(machine, &count);
    MPI_Comm_free(&machine);
    return count;
  }

  [[noreturn]] void abort(int status) const override {
    MPI_Abort(MPI_COMM_WORLD, status);
    std::abort();
  }

 private:
  MPI_Datatype vote_{};
  MPI_Op combine_{};
};

}  // namespace

std::unique_ptr<Ranks> mpi_processes() {
  int given = 0, rank = 0, size = 1;
  // Threads compute between messages, which the main thread alone sends.
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  // Signals are Talus' own.
  check(PetscOptionsSetValue(nullptr, "-no_signal_handler", nullptr), "start");
  check(PetscInitializeNoArguments(), "start");
  return std::make_unique<MpiProcesses>(rank, size);
}

}  // namespace talus
