#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include "core/atomic_file.hpp"
#include "core/map/map_file.hpp"
#include "experiments/worlds/duck_house.hpp"
#include "experiments/worlds/pig_house.hpp"

namespace {

/// One picture of the house, and a YAML file a pen: they differ in the origin.
void draw_pens(const std::filesystem::path& folder) {
  for (int pen = coop::worlds::kPens; pen >= 1; --pen) {
    const auto stem = folder / ("pig_pen_" + std::to_string(pen));
    coop::map::save_map(coop::worlds::pig_house(pen), stem);
    std::filesystem::rename(stem.string() + ".pgm", folder / "pig_house.pgm");
    const std::string yaml = coop::read_file(stem.string() + ".yaml");
    const std::string own = stem.filename().string();
    coop::write_file_atomically(stem.string() + ".yaml",
                                std::string(yaml).replace(yaml.find(own), own.size(), "pig_house"));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: draw_worlds FOLDER\n");
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    coop::map::save_map(coop::worlds::duck_house(), folder / "duck_house");
    draw_pens(folder);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "draw_worlds: %s\n", error.what());
    return 1;
  }
  return 0;
}
