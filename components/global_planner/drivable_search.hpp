#pragma once
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "core/config/fields.hpp"
#include "core/pose.hpp"
#include "core/result.hpp"
#include "core/search/dijkstra.hpp"
#include "global_planner/arc_cost.hpp"
#include "global_planner/pose_checker.hpp"
#include "global_planner/reeds_shepp.hpp"
#include "global_planner/turning_distance.hpp"

namespace coop::global_planner {

struct DrivableConfig {
  double radius_margin = 1.08;  ///< planned turning radius over the robot's smallest
  double step = 0.22;           ///< m driven from state to state
  ArcCostConfig arc_cost;
  double approach_length = 0.8;      ///< m: straight line on which the goal is to be approached
  double short_approach_cost = 5.0;  ///< m for each metre missing of it
  double greed = 1.2;                ///< weight of the estimated rest of the way
  double suboptimality = 0.2;        ///< ends when nothing can be cheaper by more than this part
  int extra_states = 2000;           ///< expanded at most once a first path is known
  int max_states = 150000;           ///< the search gives up after this many

  void describe(config::Fields& fields);
};

/// A path the base can drive: arcs of at least the turning radius and straights, forwards and
/// backwards.
struct DrivablePath {
  std::vector<Arc> arcs;
  double cost = 0.0;       ///< m of free ground, with all weights
  std::size_t states = 0;  ///< expanded by the search
};

enum class DrivableFailure : std::uint8_t { kExhausted, kTooManyStates };

/// Search over position, heading and direction of travel for a path that a car can drive (Dolgov,
/// Thrun, Montemerlo, Diebel 2010, section 2: hybrid-state A*). It goes beyond the egg paper, whose
/// Dijkstra path an Ackermann base cannot follow through tight turns, nor end with the heading that
/// equation 4 asks for. Dijkstra's cost to the goal is the heuristic, together with the length of
/// the turning manoeuvre without obstacles. States near the goal are connected to it by Reeds-Shepp
/// words that end on a straight line towards the goal. All arrays keep their size between queries.
class DrivableSearch {
 public:
  DrivableSearch(const DrivableConfig& config, double min_turning_radius);

  /// What the search needs to know of the world. `to_goal` is flooded over `grid` from the cell in
  /// which the straight approach, `approach` metres long, begins.
  struct World {
    const TraversalGrid& grid;
    const Dijkstra& to_goal;
    const PoseChecker& poses;
    double approach = 0.0;
  };
  /// Called every some milliseconds while a search goes on, for whoever must show a sign of life.
  void on_progress(std::function<void()> callback) { progress_ = std::move(callback); }

  /// `direction`: which way the robot drives now (1, -1), 0 at rest. Start and goal must be free.
  [[nodiscard]] Result<DrivablePath, DrivableFailure> plan(const World& world, const Pose2& start,
                                                           const Pose2& goal, int direction);

  /// The lengths of straight approach that are tried, longest first, m; the last is 0.
  [[nodiscard]] const std::vector<double>& approaches() const { return approaches_; }

  [[nodiscard]] double turning_radius() const { return curves_.turning_radius(); }

 private:
  struct Node {
    Pose2 pose;
    float cost;
    std::int32_t parent;
    float length;           ///< m driven from the parent, negative: backwards
    std::int8_t steering;   ///< -2 .. 2: part of the largest curvature in halves
    std::int8_t direction;  ///< 1, -1; 0 at rest
    bool closed;
  };
  struct Shot {
    double cost = 0.0;
    ArcPath word;
    double straight = 0.0;  ///< m driven forwards after the word
  };

  void clear();
  [[nodiscard]] std::uint64_t key_of(const GridGeometry& grid, const Node& node) const;
  std::int32_t* slot_of(std::uint64_t key);
  void open(const World& world, const Pose2& goal, const Node& node);
  void expand(const World& world, const Pose2& goal, std::int32_t index);
  void try_shot(const World& world, const Pose2& goal, std::int32_t index);
  [[nodiscard]] double heuristic(const World& world, const Pose2& goal, const Node& node);
  [[nodiscard]] double shot_cost(const World& world, const Node& from, const Shot& shot,
                                 double limit) const;
  [[nodiscard]] DrivablePath trace() const;

  DrivableConfig config_;
  std::function<void()> progress_ = [] {};
  ReedsShepp curves_;
  TurningDistance turning_;
  ArcCost arc_cost_;
  std::vector<double> approaches_;
  std::vector<Node> nodes_;
  std::vector<std::uint64_t> keys_;                   ///< of the nodes
  std::vector<std::int32_t> table_;                   ///< open addressing: key -> node, -1 empty
  std::vector<std::pair<float, std::int32_t>> open_;  ///< heap, lowest estimate first
  ReedsShepp::Words words_;
  std::vector<std::pair<double, Shot>> shots_;
  Shot best_shot_;
  std::int32_t best_node_ = -1;
  double best_cost_ = 0.0;
};

/// Poses along the arcs, at most `spacing` metres apart, start and every end of an arc included.
[[nodiscard]] std::vector<Pose2> sample(const std::vector<Arc>& arcs, const Pose2& start,
                                        double spacing);

}  // namespace coop::global_planner
