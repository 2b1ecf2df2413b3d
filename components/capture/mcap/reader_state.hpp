#pragma once
#include "capture/mcap/reader.hpp"

namespace coop::mcap {

/// What a reader and its cursors share.
struct ReaderState {
  std::shared_ptr<const Source> source;
  ReadLimits limits;
  Summary summary;
  Decompressor decompressor;
  std::vector<std::byte> compressed;

  /// Sees to it that the places of all messages are known.
  void need_index();
  /// The channel, if need be after looking for it in the whole file; null where there is none.
  [[nodiscard]] const Channel* channel(std::uint16_t id);
  /// The one record at this place, checked to be of this kind.
  [[nodiscard]] RawRecord read_record(Opcode opcode, std::uint64_t offset, std::uint64_t length,
                                      std::vector<std::byte>& bytes) const;
  /// Scans the file for what its summary does not have.
  void scan_file();
};

/// Runs the function; what is wrong with the file then also tells its name.
template <class Function>
auto naming_file(const Source& source, const Function& function) {
  try {
    return function();
  } catch (const FileError& error) {
    throw FileError(source.name(), error);
  }
}

}  // namespace coop::mcap
