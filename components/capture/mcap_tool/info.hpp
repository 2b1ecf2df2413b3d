#pragma once
#include <string>

#include "capture/mcap/reader.hpp"
#include "capture/mcap/recover.hpp"

namespace coop::mcap {

/// "2022-09-22 21:09:35.548411329 UTC", or seconds where the time is no date of ours (simulated
/// time begins at 0).
[[nodiscard]] std::string time_text(Nanoseconds time);
/// "3.4 MB", powers of 1000.
[[nodiscard]] std::string size_text(std::uint64_t bytes);

/// What is in the file, for people: times, counts and rates, schemas, compression, attachments.
[[nodiscard]] std::string info_text(const Reader& reader);
/// "topic time size sequence" of a message, without decoding it.
[[nodiscard]] std::string listing_text(const ReadMessage& read);
[[nodiscard]] std::string report_text(const RecoverReport& report);

}  // namespace coop::mcap
