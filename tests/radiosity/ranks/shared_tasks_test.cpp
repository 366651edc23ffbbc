/// Tasks that ranks share: each result arrives once and in order, whatever rank is slow.
#include "radiosity/ranks/shared_tasks.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "radiosity/solver/unshot_tree.h"
#include "tests/support/thread_ranks.h"

using namespace hemitex;
using namespace hemitex::tests;

namespace {

using Taken = std::vector<std::pair<std::size_t, std::string>>;

/// What rank 0 takes if `slow` sleeps before each result.
Taken takenWith(int ranks, int slow, std::size_t first, std::size_t end) {
  Mailboxes boxes(ranks);
  Taken taken;
  const auto work = [&](int rank) {
    ThreadRank messenger(boxes, rank);
    radiosity::run(&messenger,
                   {.first = first,
                    .end = end,
                    .compute =
                        [&](std::size_t task) {
                          if (rank == slow) std::this_thread::sleep_for(std::chrono::milliseconds(5));
                          return "result of " + std::to_string(task * task);
                        },
                    .take = [&](std::size_t task, const std::string& result) { taken.emplace_back(task, result); }});
  };
  std::vector<std::thread> others;
  for (int rank = 1; rank < ranks; ++rank) others.emplace_back(work, rank);
  work(0);
  for (std::thread& other : others) other.join();
  return taken;
}

}  // namespace

TEST_CASE("run gives rank 0 each result once and in order, whatever rank is slow", "[ranks]") {
  Taken expected;
  for (std::size_t task = 3; task < 40; ++task) expected.emplace_back(task, "result of " + std::to_string(task * task));
  for (const int ranks : {1, 2, 3, 7, 16})
    for (const int slow : {-1, 0, ranks - 1}) CHECK(takenWith(ranks, slow, 3, 40) == expected);
  CHECK(takenWith(3, -1, 5, 5).empty());
}

TEST_CASE("received throws RankError with the exit code of the rank that failed", "[ranks]") {
  Mailboxes boxes(2);
  ThreadRank(boxes, 1).send(0, radiosity::MessageKind::Failed, std::string(1, char{2}) + "the disk is full");
  ThreadRank rankZero(boxes, 0);
  try {
    radiosity::received(rankZero);
    FAIL("no error");
  } catch (const radiosity::RankError& error) {
    CHECK(error.exitCode == 2);
    CHECK(std::string(error.what()) == "the disk is full");
  }
}

TEST_CASE("UnshotTree::brightestPatches are those of a sorted list", "[ranks]") {
  radiosity::BandTable flux(70000, 3);
  std::uint64_t state = 1;
  for (std::size_t i = 0; i < flux.size(); ++i) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    flux[i][0] = static_cast<double>(state >> 40) - 8e6;  // some are equal
    flux[i][2] = 1;
  }
  const auto size = [&](std::uint32_t patch) { return std::abs(flux[patch][0]) + 1; };
  std::vector<std::uint32_t> sorted(flux.size());
  for (std::uint32_t i = 0; i < sorted.size(); ++i) sorted[i] = i;
  std::stable_sort(sorted.begin(), sorted.end(), [&](auto a, auto b) { return size(a) > size(b); });
  sorted.resize(300);
  const radiosity::UnshotTree tree(flux);
  const std::vector<std::uint32_t> found = tree.brightestPatches(300);
  REQUIRE(found.size() == 300);
  CHECK(found.front() == tree.brightest());
  for (std::size_t i = 0; i < found.size(); ++i) CHECK(size(found[i]) == size(sorted[i]));
}
