#include <CLI/CLI.hpp>
#include <numeric>

#include "demo/node/cleaning.hpp"
#include "demo/node/story.hpp"

int main(int argc, char** argv) {
  coop::demo::StoryOptions options;
  std::string world = "duck_house";
  std::vector<int> pens{1};
  bool all_pens = false;
  CLI::App app{
      "duck_house: a simulated robot maps a duck house, comes up again on that map, finds five "
      "eggs "
      "and collects them. pig_pen: a simulated robot cleans a pen of manure among its pigs",
      "demo"};
  app.add_option("world", world, "duck_house or pig_pen")
      ->check(CLI::IsMember({"duck_house", "pig_pen"}))
      ->capture_default_str();
  app.add_option("-o,--output", options.folder, "folder of the results")->required();
  app.add_option("--seed", options.seed, "seed of world, noise and algorithms");
  app.add_option("--domain", options.domain, "DDS domain")->check(CLI::Range(0, 232));
  app.add_option("--rate", options.rate, "simulated seconds a second")
      ->check(CLI::Range(0.1, 20.0));
  app.add_option("--set", options.settings, "component.key=value for all parts; may be repeated");
  app.add_option("--pen", pens, "pig_pen: which of the eight; may be repeated")
      ->check(CLI::Range(1, 8));
  app.add_flag("--all-pens", all_pens, "pig_pen: all eight, one after the other");
  CLI11_PARSE(app, argc, argv);
  if (world == "duck_house") return coop::demo::run_story(options);
  if (all_pens) {
    pens.resize(8);
    std::iota(pens.begin(), pens.end(), 1);
  }
  return coop::demo::run_cleaning(options, pens);
}
