#include "experiments/casma/paper_data.hpp"

#include "core/config/config.hpp"

namespace coop::casma {
namespace {

Cell cell_of(const std::vector<double>& pair) {
  return {static_cast<int>(pair.at(0)), static_cast<int>(pair.at(1))};
}

void require(bool holds, const std::string& what) {
  if (!holds) throw config::Error("the paper's data: " + what);
}

}  // namespace

void PublishedPath::describe(config::Fields& fields) {
  fields.integer("steps", steps, {});
  fields.number("time_ms", time_ms, {.unit = "ms"});
  fields.numbers("x", x, {});
  fields.numbers("y", y, {});
}

std::vector<Cell> PublishedPath::cells() const {
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < x.size(); ++i) {
    cells.push_back({static_cast<int>(x[i]), static_cast<int>(y.at(i))});
  }
  return cells;
}

void PaperMap::describe(config::Fields& fields) {
  fields.integer("id", id, {});
  fields.numbers("start", start, {});
  fields.numbers("goal", goal, {});
  fields.numbers("pigs", pigs, {});
  fields.mapping("published", published);
}

Cell PaperMap::start_cell() const {
  return cell_of(start);
}

Cell PaperMap::goal_cell() const {
  return cell_of(goal);
}

std::vector<Pig> PaperMap::pig_squares() const {
  std::vector<Pig> squares;
  for (std::size_t i = 0; i + 2 < pigs.size(); i += 3) {
    squares.push_back({{static_cast<int>(pigs[i]), static_cast<int>(pigs[i + 1])},
                       static_cast<int>(pigs[i + 2])});
  }
  return squares;
}

void Savings::describe(config::Fields& fields) {
  fields.numbers("steps", steps, {.unit = "%"});
  fields.numbers("time", time, {.unit = "%"});
}

void MovingTrials::describe(config::Fields& fields) {
  fields.numbers("time_ms", time_ms, {.unit = "ms"});
  fields.numbers("steps", steps, {});
  fields.number("mean_time_ms", mean_time_ms, {.unit = "ms"});
  fields.number("mean_steps", mean_steps, {});
}

void PilotRun::describe(config::Fields& fields) {
  fields.integer("hour", hour, {});
  fields.numbers("start", start, {});
  fields.numbers("goal", goal, {});
  fields.number("time_ms", time_ms, {.unit = "ms"});
  fields.number("actual_time_ms", actual_time_ms, {.unit = "ms"});
  fields.integer("steps", steps, {});
  fields.integer("actual_steps", actual_steps, {});
}

void Minima::describe(config::Fields& fields) {
  fields.numbers("places", places, {});
}

void Paper::describe(config::Fields& fields) {
  fields.integer("width", width, {.min = 1, .max = 1000});
  fields.integer("height", height, {.min = 1, .max = 1000});
  fields.list("maps", maps);
  fields.mapping("savings", savings);
  fields.mapping("rosenbrock", rosenbrock);
  fields.mapping("moving", moving);
  fields.list("pilot", pilot);
}

void Paper::validate() const {
  for (const PaperMap& map : maps) {
    const std::string name = "map " + std::to_string(map.id);
    require(map.start.size() == 2 && map.goal.size() == 2,
            name + ": start and goal are two numbers");
    require(map.pigs.size() % 3 == 0, name + ": a pig is three numbers");
    for (const auto& path : map.published) {
      require(path.value.x.size() == path.value.y.size(), name + ", " + path.name + ": x and y");
    }
  }
  for (const auto& saving : savings) {
    require(saving.value.steps.size() == maps.size() && saving.value.time.size() == maps.size(),
            "savings of " + saving.name);
  }
  for (const auto& minima : rosenbrock) {
    require(minima.value.places.size() % 2 == 0, "Rosenbrock, " + minima.name);
  }
  for (const PilotRun& run : pilot) {
    require(run.start.size() == 2 && run.goal.size() == 2, "pilot pen: start and goal");
  }
}

Paper load_paper(const std::filesystem::path& file) {
  return config::Document::load(file).read<Paper>();
}

}  // namespace coop::casma
