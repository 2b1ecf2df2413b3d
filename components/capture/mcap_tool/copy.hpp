#pragma once
#include <functional>

#include "capture/mcap/reader.hpp"
#include "capture/mcap/writer.hpp"

namespace coop::mcap {

/// Copies from readers into one writer: schemas and channels that are the same in several files
/// become one. The readers have to outlive it.
class Copy {
 public:
  explicit Copy(Writer& writer) : writer_(writer) {}

  void message(const ReadMessage& read);
  void attachments(const Reader& reader);
  void metadata(const Reader& reader);

 private:
  Writer& writer_;
  std::map<const Channel*, std::uint16_t> channels_;
};

/// All messages selected in the order of the file; attachments and metadata with them.
void copy_selected(Reader& reader, const Selection& selection, Writer& writer);

/// Those of several files in the order of their log time; messages of one time in the order of the
/// files.
void merge(std::span<Reader> readers, Writer& writer);

}  // namespace coop::mcap
