#include <CLI/CLI.hpp>

#include "capture/node/command_line.hpp"
#include "capture/node/topic_commands.hpp"

int main(int argc, char** argv) {
  using namespace coop::capture;
  CLI::App app{"looks at the topics of a running system", "topic"};
  app.require_subcommand(1);
  TopicArguments arguments;
  int code = 0;
  const auto add = [&](const char* name, const char* help, auto run) {
    CLI::App* command = app.add_subcommand(name, help);
    arguments.options.describe(*command);
    command->callback([&code, &arguments, run] { code = run(arguments); });
    return command;
  };
  add("list", "topics, their types, who writes and who reads them", list_topics)
      ->add_option("--wait", arguments.wait, "s, for discovery")
      ->check(CLI::Range(0.1, 60.0));
  CLI::App* echo = add("echo", "prints what is published", echo_topic);
  echo->add_option("--count", arguments.count, "end after so many messages");
  echo->add_option("--max-elements", arguments.max_elements, "of an array (default 20; 0: all)");
  const auto measure = [&](const char* name, const char* help) {
    CLI::App* command =
        add(name, help, [name](const TopicArguments& given) { return measure_topic(given, name); });
    command->add_option("--window", arguments.window, "messages considered")
        ->check(CLI::Range(2, 1000000));
    command->add_option("--count", arguments.count, "end after so many lines, one a second");
    return command;
  };
  CLI::App* hz = measure("hz", "how often messages come");
  CLI::App* bw = measure("bw", "how much comes");
  CLI::App* delay = measure("delay", "how long messages are under way");
  for (CLI::App* command : {echo, hz, bw, delay}) {
    command->add_option("topic", arguments.topic, "name")->required();
  }
  CLI::App* snapshot =
      add("snapshot", "has the recorders write to disk what they hold", save_captures);
  snapshot->add_option("reason", arguments.topic, "for those who read it later");
  snapshot->add_option("--wait", arguments.snapshot_wait, "s, for the answer");
  const int parsed = parse_or_exit_code(app, argc, argv);
  return parsed == kGoOn ? code : parsed;
}
