#include <CLI/CLI.hpp>

#include "demo/node/story.hpp"

int main(int argc, char** argv) {
  coop::demo::StoryOptions options;
  CLI::App app{
      "A simulated robot maps a duck house, comes up again on that map, finds five eggs and "
      "collects them",
      "demo"};
  app.add_option("-o,--output", options.folder, "folder of the results")->required();
  app.add_option("--seed", options.seed, "seed of world, noise and algorithms");
  app.add_option("--domain", options.domain, "DDS domain")->check(CLI::Range(0, 232));
  app.add_option("--rate", options.rate, "simulated seconds a second")
      ->check(CLI::Range(0.1, 20.0));
  app.add_option("--set", options.settings, "component.key=value for both parts; may be repeated");
  CLI11_PARSE(app, argc, argv);
  return coop::demo::run_story(options);
}
