#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "runtime/lockstep/sample_trace.hpp"

namespace {

void print(const coop::runtime::TraceSummary& summary) {
  for (const auto& [name, topic] : summary.topics) {
    fmt::print("{:016x} {:>8} {}\n", topic.hash, topic.samples, name);
  }
  fmt::print("{:016x} {:>8} samples up to tick {}\n", summary.hash, summary.samples,
             summary.last_tick);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Hash over every sample of a lockstep run with trace: true, or the first difference of two",
      "trace"};
  std::string run;
  std::string other;
  std::uint64_t until = ~std::uint64_t{0};
  app.add_option("RUN", run, "folder of a run")->required();
  app.add_option("OTHER", other, "folder of another run: compare, exit code 1 where they differ");
  app.add_option("--until-tick", until, "leave out what came after this tick");
  CLI11_PARSE(app, argc, argv);
  try {
    if (other.empty()) {
      print(coop::runtime::summarise_traces(run, until));
      return 0;
    }
    const auto difference = coop::runtime::first_difference(run, other, until);
    if (difference) {
      fmt::print("first difference: {}\n", *difference);
      return 1;
    }
    const auto summary = coop::runtime::summarise_traces(run, until);
    fmt::print("the same: {} samples up to tick {}, hash {:016x}\n", summary.samples,
               summary.last_tick, summary.hash);
    return 0;
  } catch (const std::exception& problem) {
    std::cerr << "trace: " << problem.what() << '\n';
    return 2;
  }
}
