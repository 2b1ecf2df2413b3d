#include <CLI/CLI.hpp>

#include "capture/node/command_line.hpp"
#include "capture/node/record_node.hpp"
#include "runtime/run.hpp"

namespace coop::capture {
namespace {

struct Arguments {
  std::vector<std::string> topics;
  std::vector<std::string> exclude;
  bool all = false;
  std::string output;
  std::string last;
  std::string split_time;
  std::string split_size;
  std::string compression;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.allow_extras();
  app.add_option("--topics", arguments.topics,
                 "record these: globs over the whole name (/camera/*), or regular expressions "
                 "behind re: (re:/(scan|odom))");
  app.add_option("--exclude", arguments.exclude, "leave these out: patterns as in --topics");
  app.add_flag("--all", arguments.all, "record every topic (the default)");
  app.add_option("-o,--output", arguments.output, "folder of the captures");
  app.add_option("--last", arguments.last,
                 "keep the last 10min (90s, 2h) in memory; written on a fault, on emergency stop, "
                 "and by coop snapshot");
  app.add_option("--split-time", arguments.split_time, "begin a new file after this time");
  app.add_option("--split-size", arguments.split_size, "begin a new file after so many MB");
  app.add_option("--compression", arguments.compression, "zstd, lz4 or none");
  app.footer(
      "Also: --domain N, --robot NAME, --sim-time (log times are those of /clock), --set "
      "key=value (see --print-table).");
}

int run(int argc, const char* const* argv) {
  CLI::App app{"records what goes over DDS into MCAP files", "record"};
  Arguments arguments;
  describe(app, arguments);
  if (const int code = parse_or_exit_code(app, argc, argv); code != kGoOn) return code;
  CommandLine line(argv[0]);
  auto remaining = app.remaining();
  // It takes part in no tick: what it says is no result of a run.
  std::erase(remaining, "--trace");
  line.pass_on(remaining);
  if (!arguments.all) line.set("topics", arguments.topics);
  line.set("exclude", arguments.exclude);
  try {
    if (!arguments.output.empty()) line.set("output", arguments.output);
    if (!arguments.last.empty()) line.set("last", in_seconds("--last", arguments.last));
    if (!arguments.split_time.empty())
      line.set("split_time", in_seconds("--split-time", arguments.split_time));
    if (!arguments.split_size.empty()) line.set("split_size", arguments.split_size);
    if (!arguments.compression.empty()) line.set("compression", arguments.compression);
  } catch (const CLI::ParseError& problem) {
    std::cerr << "record: " << problem.what() << '\n';
    return 2;
  }
  const auto all = line.argv();
  return runtime::run<RecordNode>(static_cast<int>(all.size()), all.data(), "record",
                                  "records what goes over DDS into MCAP files");
}

}  // namespace
}  // namespace coop::capture

int main(int argc, char** argv) {
  return coop::capture::run(argc, argv);
}
