#include "capture/mcap/ring_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <system_error>

#include "capture/mcap/decode.hpp"

namespace coop::mcap {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw std::system_error(errno, std::generic_category(), path.string());
}

/// Locked before anybody can find the folder under its name.
int make_folder(const Ring& ring) {
  const auto hidden = ring.folder.parent_path() / ("." + ring.folder.filename().string());
  if (::mkdir(hidden.c_str(), 0700) != 0) fail(ring.folder);
  const auto origin = hidden / RingFolder::kOrigin;
  const int file = ::open(origin.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  const std::string text = ring.origin.string();
  const bool made = file >= 0 && ::flock(file, LOCK_EX | LOCK_NB) == 0 &&
                    ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
                    ::rename(hidden.c_str(), ring.folder.c_str()) == 0;
  if (made) return file;
  const int error = errno;
  if (file >= 0) ::close(file);
  std::error_code ignored;
  std::filesystem::remove_all(hidden, ignored);
  errno = error;
  fail(ring.folder);
}

/// Bytes of the file system, or half of a small one, that are left to others: where it is /dev/shm,
/// Fast DDS has its shared memory there and ends by SIGBUS when there is no room for it.
constexpr std::uint64_t kReserve = std::uint64_t{256} << 20U;

FileOptions options_in(const std::filesystem::path& folder, FileOptions options) {
  options.layout.data_crc = false;
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(folder, error);
  options.reserve = error ? 0 : std::min<std::uint64_t>(space.capacity / 2, kReserve);
  return options;
}

}  // namespace

struct RingFolder::Segment {
  explicit Segment(std::filesystem::path where) : path(std::move(where)) {}
  ~Segment() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
  Segment(const Segment&) = delete;
  Segment& operator=(const Segment&) = delete;

  std::filesystem::path path;
  std::unique_ptr<FileWriter> file;  // while it is being written
  std::shared_ptr<const Source> source;
  Nanoseconds begin = 0;
};

RingFolder::RingFolder(const Ring& ring, const FileOptions& options, const Definitions& definitions)
    : ring_(ring),
      options_(options_in(ring.folder.parent_path(), options)),
      definitions_(definitions),
      lock_(make_folder(ring)) {
  try {
    begin_ = std::make_unique<FileWriter>(create_file(ring_.folder / kBegin, options_.reserve),
                                          options_.header, options_.layout);
  } catch (const std::system_error&) {
    ::close(lock_);
    std::error_code ignored;
    std::filesystem::remove_all(ring_.folder, ignored);
    throw;
  }
}

RingFolder::~RingFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(ring_.folder, ignored);
  ::close(lock_);
}

bool RingFolder::is_full_for(const ReadyChunk& chunk) const {
  return segment_->file->size() + chunk.chunk.records.size() > ring_.max_bytes / kSegments ||
         chunk.chunk.message_end_time > segment_->begin + ring_.duration / kSegments;
}

void RingFolder::begin_segment(Nanoseconds time) {
  if (segment_) segment_->file.reset();
  segment_.reset();
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "%08zu.mcap", ++segments_);
  auto segment = std::make_shared<Segment>(ring_.folder / name.data());
  segment->begin = time;
  segment->file = std::make_unique<FileWriter>(create_file(segment->path, options_.reserve),
                                               options_.header, options_.layout);
  segment->source = open_plain_file(segment->path);
  const Definitions::View all = definitions_.after(0, 0);
  for (const Schema* schema : all.schemas) segment->file->add(*schema);
  for (const Channel* channel : all.channels) segment->file->add(*channel);
  if (ring_.said_before) {
    for (const StoredMessage& said : ring_.said_before(time)) {
      segment->file->add(said.message);
    }
  }
  schemas_ = all.schemas.size();
  channels_ = all.channels.size();
  segment_ = std::move(segment);
}

RingFolder::Place RingFolder::add(const ReadyChunk& chunk) {
  if (!segment_ || is_full_for(chunk)) begin_segment(chunk.chunk.message_start_time);
  FileWriter& file = *segment_->file;
  const std::uint64_t offset = file.size();
  const Definitions::View fresh = definitions_.after(schemas_, channels_);
  file.add(chunk, fresh.schemas, fresh.channels);
  schemas_ += fresh.schemas.size();
  channels_ += fresh.channels.size();
  return {segment_, offset, file.size() - offset};
}

RingFolder::ReadChunk RingFolder::read(const Place& place) {
  ReadChunk read;
  read.bytes.resize(static_cast<std::size_t>(place.length));
  place.segment->source->read(place.offset, read.bytes);
  RecordCursor cursor(read.bytes, place.offset);
  RawRecord record;
  while (cursor.next(record)) {
    if (record.opcode == Opcode::kChunk) read.chunk = decode_chunk(record);
    if (record.opcode != Opcode::kMessageIndex) continue;
    MessageIndex index = decode_message_index(record);
    read.channels.push_back({index.channel_id, std::move(index.entries)});
  }
  return read;
}

}  // namespace coop::mcap
