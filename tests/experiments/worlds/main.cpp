#include <cstdio>
#include <exception>
#include <filesystem>

#include "core/map/map_file.hpp"
#include "experiments/worlds/duck_house.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: draw_worlds FOLDER\n");
    return 2;
  }
  try {
    coop::map::save_map(coop::worlds::duck_house(), std::filesystem::path(argv[1]) / "duck_house");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "draw_worlds: %s\n", error.what());
    return 1;
  }
  return 0;
}
