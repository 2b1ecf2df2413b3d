// What is in captures, as values: `mcap_values cat|csv|diff`.
#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>

#include "capture/values/compare_captures.hpp"
#include "capture/values/export_csv.hpp"
#include "capture/values/print_messages.hpp"

namespace coop::capture {
namespace {

constexpr std::size_t kCsvElements = 1000;

struct Arguments {
  std::string file;
  std::string other;
  std::string topic;
  std::string output;
  std::vector<std::string> topics;
  std::size_t max_elements = 0;  // 0: all
  bool json = false;
  bool ignore_times = false;
};

/// To a file, or to standard output where none is named.
template <class Write>
void write_to(const std::string& output, const Write& write) {
  if (output.empty() || output == "-") return write(std::cout);
  std::ofstream file(output, std::ios::binary);
  if (!file) throw std::system_error(errno, std::generic_category(), output);
  write(file);
}

std::size_t limit_of(std::size_t elements) {
  return elements > 0 ? elements : std::numeric_limits<std::size_t>::max();
}

int cat(const Arguments& arguments) {
  mcap::Reader reader(arguments.file);
  PrintOptions options;
  options.selection.topics = arguments.topics;
  options.format = arguments.json ? PrintFormat::kJson : PrintFormat::kYaml;
  options.text.max_elements = limit_of(arguments.max_elements);
  PrintReport report;
  write_to(arguments.output,
           [&](std::ostream& out) { report = print_messages(reader, options, out); });
  if (report.undecoded > 0) {
    std::cerr << report.undecoded << " of " << report.messages << " messages are not decoded\n";
  }
  return 0;
}

int csv(const Arguments& arguments) {
  mcap::Reader reader(arguments.file);
  const CsvOptions options{.max_elements = limit_of(arguments.max_elements)};
  write_to(arguments.output, [&](std::ostream& out) {
    const CsvReport report = export_csv(reader, arguments.topic, options, out);
    if (&out != &std::cout) {
      std::cout << arguments.output << ": " << report.rows << " rows of " << report.columns
                << " columns\n";
    }
  });
  return 0;
}

int diff(const Arguments& arguments) {
  mcap::Reader first(arguments.file);
  mcap::Reader second(arguments.other);
  bool same = true;
  for (const auto& topic : compare_captures(first, second, arguments.topics)) {
    same = same && topic.is_same(!arguments.ignore_times);
    std::cout << topic.text() << '\n';
  }
  std::cout << (same ? "no difference\n" : "the captures differ\n");
  return same ? 0 : 1;
}

int run(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("What is in MCAP captures of CDR messages, as values", "mcap_values");
  app.require_subcommand(1);

  auto* cat_command = app.add_subcommand("cat", "messages as YAML or, one a line, as JSON");
  cat_command->add_option("FILE", arguments.file)->required();
  cat_command->add_option("-t,--topics", arguments.topics, "these topics only")->delimiter(',');
  cat_command->add_flag("--json,!--yaml", arguments.json, "JSON lines instead of YAML documents");
  cat_command->add_option("--max-array", arguments.max_elements,
                          "cut arrays longer than this (0: none)");
  cat_command->add_option("-o,--output", arguments.output, "a file instead of standard output");

  auto* csv_command = app.add_subcommand("csv", "a topic as a table");
  csv_command->add_option("FILE", arguments.file)->required();
  csv_command->add_option("TOPIC", arguments.topic)->required();
  csv_command->add_option("--max-array", arguments.max_elements,
                          "columns for that many elements of an array (0: for all; default 1000)");
  csv_command->add_option("-o,--output", arguments.output, "a file instead of standard output");

  auto* diff_command =
      app.add_subcommand("diff", "first difference of each topic; exit code 1 where there is any");
  diff_command->add_option("A", arguments.file)->required();
  diff_command->add_option("B", arguments.other)->required();
  diff_command->add_option("-t,--topics", arguments.topics, "these topics only")->delimiter(',');
  diff_command->add_flag("--ignore-times", arguments.ignore_times,
                         "log times are told, but are no difference");
  CLI11_PARSE(app, argc, argv);
  if (*cat_command) return cat(arguments);
  if (*csv_command) {
    if (csv_command->count("--max-array") == 0) arguments.max_elements = kCsvElements;
    return csv(arguments);
  }
  return diff(arguments);
}

}  // namespace
}  // namespace coop::capture

int main(int argc, char** argv) {
  try {
    std::ios::sync_with_stdio(false);
    return coop::capture::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "mcap_values: " << error.what() << '\n';
    return 2;
  }
}
