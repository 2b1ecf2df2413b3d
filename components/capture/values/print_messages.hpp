#pragma once
#include <iosfwd>

#include "capture/mcap/reader.hpp"
#include "capture/schema/message_text.hpp"

namespace coop::capture {

enum class PrintFormat : std::uint8_t {
  kYaml,  ///< a document a message
  kJson,  ///< an object a line
};

struct PrintOptions {
  mcap::Selection selection{};
  PrintFormat format = PrintFormat::kYaml;
  TextOptions text{};
};

struct PrintReport {
  std::uint64_t messages = 0;
  std::uint64_t undecoded = 0;  ///< shown by their size and the reason alone
};

/// Writes messages with topic, sequence, log time and publish time (s) and their fields under
/// `data`. Where a message cannot be decoded, `data` is null and `error` says why. Throws as the
/// reader does, and std::runtime_error where the stream takes no more.
PrintReport print_messages(mcap::Reader& reader, const PrintOptions& options, std::ostream& out);

}  // namespace coop::capture
