#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>

#include "capture/mcap_tool/attachments.hpp"
#include "capture/mcap_tool/copy.hpp"
#include "capture/mcap_tool/info.hpp"
#include "capture/mcap_tool/rosbag2.hpp"
#include "capture/schema/definitions.hpp"

namespace coop::mcap {
namespace {

namespace fs = std::filesystem;

/// A point of time as people give it: "12.5" seconds after the file's first message, or
/// "@1663967375.5" seconds since 1970.
Nanoseconds time_of(const std::string& text, const Summary& summary) {
  const bool absolute = text.starts_with('@');
  std::size_t used = 0;
  long double seconds = 0;
  try {
    seconds = std::stold(text.substr(absolute ? 1 : 0), &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used + (absolute ? 1 : 0) != text.size() || !(seconds >= 0) || seconds > 1e10L) {
    throw std::invalid_argument("no time '" + text +
                                "': seconds after the file's begin, or @seconds since 1970");
  }
  const auto span = static_cast<Nanoseconds>(std::llround(seconds * 1e9L));
  const Nanoseconds begin = summary.statistics ? summary.statistics->message_start_time : 0;
  return absolute ? span : begin + span;
}

struct SelectionArguments {
  std::vector<std::string> topics;
  std::vector<std::string> exclude;
  std::string start;
  std::string end;

  void add_to(CLI::App& verb) {
    verb.add_option("-t,--topics", topics, "only these topics");
    verb.add_option("-x,--exclude", exclude, "all topics but these");
    verb.add_option("--start", start, "from here on: seconds after the begin, or @seconds of 1970");
    verb.add_option("--end", end, "before this, likewise");
  }

  [[nodiscard]] Selection of(const Reader& reader) const {
    const Summary& summary = reader.summary();
    const auto there = [&](const std::string& topic) {
      return std::ranges::any_of(summary.channels,
                                 [&](const auto& one) { return one.second.topic == topic; });
    };
    for (const std::string& topic : topics) {
      if (!there(topic)) throw std::invalid_argument("no topic '" + topic + "' in the file");
    }
    Selection selection;
    selection.topics = topics;
    for (const auto& [id, channel] : summary.channels) {
      const std::string& topic = channel.topic;
      if (exclude.empty() || std::ranges::count(exclude, topic) > 0) continue;
      if (topics.empty()) selection.topics.push_back(topic);
    }
    std::erase_if(selection.topics,
                  [&](const std::string& topic) { return std::ranges::count(exclude, topic) > 0; });
    if (!exclude.empty() && selection.topics.empty()) {
      throw std::invalid_argument("no topic is left");
    }
    if (!start.empty()) selection.start = time_of(start, summary);
    if (!end.empty()) selection.end = time_of(end, summary);
    return selection;
  }
};

struct OutputArguments {
  fs::path path;
  std::string compression = "zstd";

  void add_to(CLI::App& verb) {
    verb.add_option("-o,--output", path, "the new file")->required();
    verb.add_option("--compression", compression, "zstd, lz4 or none")->capture_default_str();
  }

  /// `fill` writes into the new file; throws where the disk failed. No input is overwritten.
  void write(const std::vector<fs::path>& inputs, const Header& header,
             const std::function<void(Writer&)>& fill) const {
    for (const fs::path& input : inputs) {
      if (fs::exists(path) && fs::equivalent(input, path)) {
        throw std::invalid_argument("-o " + path.string() + " is an input");
      }
    }
    WriterOptions options;
    options.file.header = header;
    options.compression = compression_named(compression);
    options.level = options.compression == Compression::kZstd ? 3 : 0;
    options.when_full = WhenFull::kWait;
    Writer writer(Series{path}, options);
    fill(writer);
    writer.close();
    const WriterStatus status = writer.status();
    if (!status.error.empty()) throw std::runtime_error(status.error);
    fmt::print("{}: {} messages, {}\n", path.string(), status.messages, size_text(status.bytes));
  }
};

void note_incomplete(const Reader& reader) {
  if (reader.summary().complete) return;
  fmt::print(stderr, "mcap: {}: incomplete: {}\n", reader.source().name(), reader.summary().defect);
}

/// The verb's action, run once its arguments are read.
using Action = std::function<void()>;

Action add_info(CLI::App& app) {
  auto file = std::make_shared<fs::path>();
  app.add_option("FILE", *file)->required();
  return [file] { fmt::print("{}", info_text(Reader(*file))); };
}

Action add_cat(CLI::App& app) {
  struct Arguments {
    fs::path file;
    SelectionArguments selection;
  };
  auto arguments = std::make_shared<Arguments>();
  app.add_option("FILE", arguments->file)->required();
  arguments->selection.add_to(app);
  return [arguments] {
    Reader reader(arguments->file);
    note_incomplete(reader);
    MessageCursor cursor = reader.messages(arguments->selection.of(reader));
    while (const auto read = cursor.next()) fmt::print("{}\n", listing_text(*read));
  };
}

Action add_recover(CLI::App& app) {
  struct Arguments {
    fs::path file;
    fs::path output;
  };
  auto arguments = std::make_shared<Arguments>();
  app.add_option("FILE", arguments->file)->required();
  app.add_option("-o,--output", arguments->output, "the new file (default: FILE_recovered.mcap)");
  return [arguments] {
    const fs::path& file = arguments->file;
    fs::path output = arguments->output;
    if (output.empty()) output = file.parent_path() / (file.stem().string() + "_recovered.mcap");
    if (fs::exists(output) && fs::equivalent(file, output)) {
      throw std::invalid_argument("-o " + output.string() + " is the file itself");
    }
    // What is no MCAP file at all leaves no new file.
    const auto source = open_file(file);
    static_cast<void>(read_begin(source, {}));
    const RecoverReport report = recover(source, create_file(output));
    fmt::print("{}{}\n", report_text(report), output.string());
  };
}

Action add_filter(CLI::App& app) {
  struct Arguments {
    fs::path file;
    SelectionArguments selection;
    OutputArguments output;
  };
  auto arguments = std::make_shared<Arguments>();
  app.add_option("FILE", arguments->file)->required();
  arguments->selection.add_to(app);
  arguments->output.add_to(app);
  return [arguments] {
    Reader reader(arguments->file);
    note_incomplete(reader);
    const Selection selection = arguments->selection.of(reader);
    arguments->output.write({arguments->file}, reader.summary().header,
                            [&](Writer& writer) { copy_selected(reader, selection, writer); });
  };
}

Action add_merge(CLI::App& app) {
  struct Arguments {
    std::vector<fs::path> files;
    OutputArguments output;
  };
  auto arguments = std::make_shared<Arguments>();
  app.add_option("FILES", arguments->files)->required()->expected(1, -1);
  arguments->output.add_to(app);
  return [arguments] {
    std::vector<Reader> readers;
    for (const fs::path& file : arguments->files) {
      readers.emplace_back(file);
      note_incomplete(readers.back());
    }
    arguments->output.write(arguments->files, readers.front().summary().header,
                            [&](Writer& writer) { merge(readers, writer); });
  };
}

Action add_attachments(CLI::App& app) {
  struct Arguments {
    fs::path file;
    std::vector<std::string> names;
    fs::path folder;
  };
  auto arguments = std::make_shared<Arguments>();
  app.add_option("FILE", arguments->file)->required();
  app.add_option("NAMES", arguments->names, "only these");
  app.add_option("--extract", arguments->folder, "write them into this folder");
  return [arguments] {
    const Reader reader(arguments->file);
    note_incomplete(reader);
    if (!arguments->folder.empty()) {
      for (const fs::path& file :
           extract_attachments(reader, arguments->names, arguments->folder)) {
        fmt::print("{}\n", file.string());
      }
      return;
    }
    for (const AttachmentIndex& index : reader.summary().attachments) {
      fmt::print("{:>10} {} {} {}\n", size_text(index.data_size), time_text(index.log_time),
                 index.media_type, index.name);
    }
  };
}

Action add_import(CLI::App& app) {
  struct Arguments {
    fs::path bag;
    OutputArguments output;
  };
  auto arguments = std::make_shared<Arguments>();
  app.add_option("BAG", arguments->bag, "folder of a rosbag2 recording (sqlite3), or one .db3 file")
      ->required();
  arguments->output.add_to(app);
  return [arguments] {
    const auto definition_of = [](std::string_view type) -> std::optional<std::string> {
      const auto text = capture::ros2msg_definition(type);
      return text ? std::optional<std::string>(*text) : std::nullopt;
    };
    arguments->output.write({arguments->bag}, {"ros2", "coop mcap import"}, [&](Writer& writer) {
      const ImportReport report = import_rosbag2(arguments->bag, definition_of, writer);
      for (const std::string& type : report.unknown_types) {
        fmt::print(stderr, "mcap: no definition of {}: its channels have no schema text\n", type);
      }
    });
  };
}

int run(int argc, char** argv) {
  CLI::App app("Looks into MCAP captures, completes, cuts, merges and imports them.", "mcap");
  app.require_subcommand(1);
  const auto verb = [&](const char* name, const char* what, Action (*add)(CLI::App&)) {
    CLI::App* sub = app.add_subcommand(name, what);
    sub->callback(add(*sub));
    return sub;
  };
  verb("info", "times, channels, schemas, compression, attachments", add_info);
  verb("cat", "one line a message, without decoding it", add_cat);
  verb("recover", "a complete file of one that was cut or damaged", add_recover);
  verb("filter", "a part of a file, by time and topic", add_filter)->alias("cut");
  verb("merge", "several files as one, in the order of time", add_merge);
  verb("attachments", "list or extract them", add_attachments);
  verb("import", "a rosbag2 recording (sqlite3) as MCAP", add_import);
  CLI11_PARSE(app, argc, argv);
  return 0;
}

}  // namespace
}  // namespace coop::mcap

int main(int argc, char** argv) {
  try {
    return coop::mcap::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "mcap: {}\n", error.what());
    return 1;
  }
}
