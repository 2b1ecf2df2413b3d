#include <CLI/CLI.hpp>

#include "capture/node/command_line.hpp"
#include "capture/node/play_node.hpp"
#include "runtime/run.hpp"

namespace coop::capture {
namespace {

struct Arguments {
  std::string file;
  std::string rate;
  std::string start;
  std::string duration;
  std::string wait;
  std::vector<std::string> topics;
  std::vector<std::string> exclude;
  std::vector<std::string> without;
  std::vector<std::string> remap;
  std::vector<std::string> readers;
  bool loop = false;
  bool no_clock = false;
  bool paused = false;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.allow_extras();
  app.add_option("--rate", arguments.rate,
                 "seconds of the capture a second; 0: as fast as readers follow");
  app.add_flag("--loop", arguments.loop, "begin anew at the end");
  app.add_option("--start", arguments.start, "begin so far into the capture (30, 2min)");
  app.add_option("--duration", arguments.duration, "play so much of it");
  app.add_option("--topics", arguments.topics,
                 "play these: globs over the whole name, or regular expressions behind re:");
  app.add_option("--exclude", arguments.exclude, "leave these out");
  app.add_option("--without", arguments.without, "leave out what these components wrote");
  app.add_option("--remap", arguments.remap, "FROM:=TO: publish a topic under another name");
  app.add_option("--readers", arguments.readers, "wait until somebody reads these");
  app.add_option("--wait", arguments.wait, "wait so long for readers (default 5 s)");
  app.add_flag("--no-clock", arguments.no_clock,
               "publish no /clock of one's own; one in the capture is played like any topic");
  app.add_flag("--paused", arguments.paused, "wait for the space bar");
  app.footer(
      "Keys: space pauses and goes on, n plays the next message while paused, q ends.\n"
      "Also: --domain N, --robot NAME, --reliable-streams, --set key=value (see "
      "--print-table).");
}

void translate(const Arguments& arguments, CommandLine& line) {
  if (!arguments.file.empty()) line.set("file", arguments.file);
  if (!arguments.rate.empty()) line.set("rate", arguments.rate);
  if (!arguments.start.empty()) line.set("start", in_seconds("--start", arguments.start));
  if (!arguments.duration.empty())
    line.set("duration", in_seconds("--duration", arguments.duration));
  if (!arguments.wait.empty()) line.set("wait", in_seconds("--wait", arguments.wait));
  line.set("topics", arguments.topics);
  line.set("exclude", arguments.exclude);
  line.set("without", arguments.without);
  line.set("remap", arguments.remap);
  line.set("readers", arguments.readers);
  if (arguments.loop) line.set("loop", "true");
  if (arguments.no_clock) line.set("clock", "false");
  if (arguments.paused) line.set("paused", "true");
  // A person's terminal; under the launcher the file comes with the configuration.
  if (!arguments.file.empty()) line.set("keyboard", "true");
}

int run(int argc, const char* const* argv) {
  CLI::App app{
      "plays a capture (MCAP) over DDS: coop play FILE [OPTIONS]; FILE may be a folder of the "
      "parts of one",
      "play"};
  Arguments arguments;
  describe(app, arguments);
  std::vector<const char*> options(argv, argv + argc);
  // Only here: elsewhere it could be the value of an option that is passed on.
  if (argc > 1 && argv[1][0] != '-') {
    arguments.file = argv[1];
    options.erase(options.begin() + 1);
  }
  if (const int code = parse_or_exit_code(app, static_cast<int>(options.size()), options.data());
      code != kGoOn) {
    return code;
  }
  CommandLine line(argv[0]);
  line.pass_on(app.remaining());
  try {
    translate(arguments, line);
  } catch (const CLI::ParseError& problem) {
    std::cerr << "play: " << problem.what() << '\n';
    return 2;
  }
  const auto all = line.argv();
  return runtime::run<PlayNode>(static_cast<int>(all.size()), all.data(), "play",
                                "plays captures (MCAP) over DDS");
}

}  // namespace
}  // namespace coop::capture

int main(int argc, char** argv) {
  return coop::capture::run(argc, argv);
}
