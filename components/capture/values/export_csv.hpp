#pragma once
#include <iosfwd>

#include "capture/mcap/reader.hpp"
#include "capture/schema/csv_columns.hpp"

namespace coop::capture {

struct CsvReport {
  std::uint64_t rows = 0;
  std::size_t columns = 0;
};

/// A topic as a table: a line of names, then a row a message in the order of log time, which is the
/// first column (s). Reads the topic twice, since arrays get as many columns as the longest one
/// has. Throws std::runtime_error: no such topic, a channel that cannot be decoded, channels of
/// different types under the topic's name, a malformed message.
CsvReport export_csv(mcap::Reader& reader, const std::string& topic, const CsvOptions& options,
                     std::ostream& out);

}  // namespace coop::capture
