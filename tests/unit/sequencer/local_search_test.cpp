#include "sequencer/local_search.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "unit/sequencer/cost_matrices.hpp"

namespace coop::sequencer {
namespace {

using Vertex = TourProblem::Vertex;
using Vertices = std::vector<Vertex>;

Vertices shuffled(std::size_t count, RandomStream& random) {
  Vertices tour(count);
  std::iota(tour.begin(), tour.end(), Vertex{0});
  for (std::size_t i = count - 1; i > 0; --i) std::swap(tour[i], tour[random.below(i + 1)]);
  return tour;
}

bool is_permutation(const Vertices& tour) {
  std::vector<bool> seen(tour.size(), false);
  for (const Vertex v : tour) seen.at(v) = true;
  return std::ranges::count(seen, true) == static_cast<std::ptrdiff_t>(tour.size());
}

/// No exchange of two edges of a symmetric tour without fixed edges makes it shorter.
bool no_pair_of_edges_can_be_exchanged(const TourProblem& problem, const Vertices& tour) {
  const std::size_t n = tour.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      const Vertex a = tour[i], b = tour[i + 1], c = tour[j], d = tour[(j + 1) % n];
      if (problem.cost(a, c) + problem.cost(b, d) <
          problem.cost(a, b) + problem.cost(c, d) - 1e-6) {
        return false;
      }
    }
  }
  return true;
}

TEST(LocalSearchTest, CrossingEdgesAreUntangled) {
  const TourProblem problem(test::distances({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {-1, 0.5}}), true, 4);
  Vertices tour{0, 2, 1, 3, 4};
  LocalSearch(problem).improve(tour, {});
  EXPECT_NEAR(problem.length(tour), 3.0 + 2.0 * std::hypot(1.0, 0.5), 1e-12);
}

TEST(LocalSearchTest, AnEggLeftOutOnTheWayIsTakenInPassing) {
  // Out to 5 m and back along a corridor; the place at 2 m comes last.
  const TourProblem problem(test::distances({{0, 0}, {1, 0}, {3, 0}, {4, 0}, {5, 0}, {2, 0.1}}),
                            false, 5);
  Vertices tour{0, 1, 2, 3, 4, 5, problem.end()};
  LocalSearch(problem).improve(tour, {});
  EXPECT_EQ(problem.order(tour), (std::vector<std::size_t>{1, 5, 2, 3, 4}));
}

TEST(LocalSearchTest, WithAllNeighboursNoPairOfEdgesIsLeftToExchange) {
  RandomStream random(1, "tours");
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const TourProblem problem(test::random_places(40, seed), true, 39);
    LocalSearch search(problem);
    Vertices tour = shuffled(problem.size(), random);
    const double before = problem.length(tour);
    search.improve(tour, {});
    ASSERT_TRUE(is_permutation(tour));
    EXPECT_LT(problem.length(tour), before);
    EXPECT_TRUE(no_pair_of_edges_can_be_exchanged(problem, tour)) << "seed " << seed;
  }
}

TEST(LocalSearchTest, FixedEdgesStay) {
  RandomStream random(2, "tours");
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const TourProblem problem(test::asymmetric_places(25, seed), seed % 2 == 0, 8);
    Vertices tour;
    for (const Vertex v : shuffled(25, random)) {
      tour.push_back(v);
      tour.push_back(problem.partner(v));
    }
    const double before = problem.length(tour);
    LocalSearch(problem).improve(tour, {});
    ASSERT_TRUE(is_permutation(tour));
    EXPECT_LT(problem.length(tour), before);
    for (std::size_t i = 0; i < tour.size(); ++i) {
      const Vertex partner = problem.partner(tour[i]);
      EXPECT_TRUE(tour[(i + 1) % tour.size()] == partner ||
                  tour[(i + tour.size() - 1) % tour.size()] == partner);
    }
  }
}

TEST(LocalSearchTest, ATourThatIsItsOwnReferenceStaysAsItIs) {
  const TourProblem problem(test::random_places(30, 3), true, 8);
  RandomStream random(3, "tours");
  Vertices tour = shuffled(problem.size(), random);
  const Vertices before = tour;
  LocalSearch(problem).improve(tour, before);
  EXPECT_EQ(tour, before);
}

}  // namespace
}  // namespace coop::sequencer
