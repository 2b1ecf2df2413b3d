#include <algorithm>
#include <set>
#include <system_error>

#include "capture/mcap/chunk_search.hpp"
#include "capture/mcap/crc.hpp"
#include "capture/mcap/encode.hpp"
#include "capture/mcap/record_stream.hpp"
#include "capture/mcap/tail.hpp"

namespace coop::mcap {
namespace {

/// Content of a Chunk record before its records: long enough for any name of a compression.
constexpr std::uint64_t kChunkHead = 64;
/// Places of a damaged capture behind which chunks are looked for.
constexpr int kMostDamage = 1000;

/// The numbers of a slot's head, as they lie in the file.
struct HeadNumbers {
  std::uint64_t magic = 0;
  std::uint64_t capacity = 0;
  std::uint64_t ordinal = 0;
  std::uint64_t size = 0;
};

HeadNumbers read_head(const Source& tail, std::uint64_t offset) {
  std::array<std::byte, 32> bytes{};
  tail.read(offset, bytes);
  const auto number = [&](std::size_t i) { return load_u64(Bytes(bytes).subspan(8 * i)); };
  return {number(0), number(1), number(2), number(3)};
}

/// The records of a slot; none where it changes hands meanwhile: they are in the capture by now.
std::vector<std::byte> read_slot(const Source& tail, std::uint64_t offset,
                                 const HeadNumbers& head) {
  std::vector<std::byte> records(head.size);
  tail.read(offset + Tail::kHead, records);
  const HeadNumbers after = read_head(tail, offset);
  if (after.ordinal != head.ordinal || after.size < head.size) records.clear();
  return records;
}

/// What a capture that was cut has got.
struct Whole {
  std::uint64_t end = 0;                                       ///< of the last whole record
  std::set<std::pair<std::uint64_t, std::uint32_t>> chunks{};  ///< sizes and CRCs
};

/// Damage in its midst does not end it: recovery finds the chunks behind.
Whole whole_records(const std::shared_ptr<const Source>& capture, std::uint64_t begin) {
  Whole whole{begin};
  RecordStream stream(capture, {}, begin, capture->size());
  for (int damage = 0; damage < kMostDamage;) {
    const std::uint64_t offset = stream.position();
    try {
      const auto place = stream.next();
      if (!place || place->opcode == Opcode::kDataEnd) break;
      if (place->opcode == Opcode::kChunk) {
        const auto head =
            decode_chunk_head(stream.content_prefix(kChunkHead), place->content_length);
        whole.chunks.emplace(head.chunk.uncompressed_size, head.chunk.uncompressed_crc);
      }
      whole.end = place->end();
    } catch (const FileError&) {
      ++damage;
      stream.seek(find_chunk(stream, offset + 1));
    }
  }
  return whole;
}

/// As far as its records are whole.
void append_chunk(ByteBuffer& out, Bytes records) {
  Chunk chunk;
  bool first = true;
  RecordCursor cursor(records);
  std::size_t end = 0;
  try {
    RawRecord record;
    while (cursor.next(record)) {
      if (record.opcode == Opcode::kMessage) {
        const Nanoseconds time = decode_message(record).log_time;
        chunk.message_start_time = first ? time : std::min(chunk.message_start_time, time);
        chunk.message_end_time = first ? time : std::max(chunk.message_end_time, time);
        first = false;
      }
      end = cursor.position();
    }
  } catch (const FileError&) {
    // Damaged from here on.
  }
  if (end == 0) return;
  chunk.records = records.first(end);
  chunk.uncompressed_size = end;
  chunk.uncompressed_crc = crc32_of(chunk.records);
  encode_before_records(out, chunk);
  out.raw(chunk.records);
}

/// Of NAME_0002.mcap also that of NAME.mcap: the parts of a capture have one tail.
std::filesystem::path existing_tail(const std::filesystem::path& capture) {
  std::error_code error;
  auto own = Tail::path_of(capture);
  if (std::filesystem::exists(own, error)) return own;
  const std::string stem = capture.stem().string();
  const auto bar = stem.rfind('_');
  if (bar == std::string::npos) return {};
  auto whole = capture;
  whole.replace_filename(stem.substr(0, bar) + capture.extension().string());
  const auto shared = Tail::path_of(whole);
  return std::filesystem::exists(shared, error) ? shared : std::filesystem::path();
}

bool is_complete(const Source& capture) {
  std::array<std::byte, kMagic.size()> end{};
  if (capture.size() < kMagic.size() + kFooterRecord) return false;
  capture.read(capture.size() - end.size(), end);
  return end == kMagic;
}

/// A capture up to a place, and what is appended there.
class Appended final : public Source {
 public:
  Appended(std::shared_ptr<const Source> capture, std::uint64_t begin, ByteBuffer rest)
      : capture_(std::move(capture)), begin_(begin), rest_(std::move(rest)) {}
  [[nodiscard]] std::uint64_t size() const override { return begin_ + rest_.size(); }
  [[nodiscard]] const std::string& name() const override { return capture_->name(); }
  void read(std::uint64_t offset, std::span<std::byte> out) const override {
    const std::uint64_t left = offset < begin_ ? begin_ - offset : 0;
    const auto before = static_cast<std::size_t>(std::min<std::uint64_t>(left, out.size()));
    if (before > 0) capture_->read(offset, out.first(before));
    const std::uint64_t from = offset + before - begin_;
    if (out.size() - before > rest_.size() - std::min<std::uint64_t>(from, rest_.size())) {
      throw FileError(size(), "the file ends here");
    }
    std::ranges::copy(rest_.view().subspan(static_cast<std::size_t>(from), out.size() - before),
                      out.subspan(before).begin());
  }

 private:
  std::shared_ptr<const Source> capture_;
  std::uint64_t begin_;
  ByteBuffer rest_;
};

}  // namespace

std::vector<TailChunk> chunks_of_tail(const Source& tail, std::uint64_t max_bytes) {
  std::vector<TailChunk> chunks;
  std::uint64_t offset = 0;
  try {
    while (offset < tail.size() && tail.size() - offset > Tail::kHead) {
      const HeadNumbers head = read_head(tail, offset);
      const std::uint64_t room = tail.size() - offset - Tail::kHead;
      if (head.magic != Tail::kSlotMagic || head.capacity > room || head.size > head.capacity)
        break;
      if (head.size > 0 && head.size <= max_bytes) {
        TailChunk found{head.ordinal, read_slot(tail, offset, head)};
        max_bytes -= found.records.size();
        if (!found.records.empty()) chunks.push_back(std::move(found));
      }
      offset += Tail::slot_size(head.capacity);
    }
  } catch (const FileError&) {
    // Cut while it is read: what was found so far is good.
  }
  std::ranges::stable_sort(chunks, {}, &TailChunk::ordinal);
  return chunks;
}

std::vector<TailChunk> read_tail(const std::filesystem::path& capture) {
  const auto tail = existing_tail(capture);
  if (tail.empty()) return {};
  try {
    return chunks_of_tail(*open_plain_file(tail));
  } catch (const std::system_error&) {
    return {};  // gone meanwhile: the capture was closed
  }
}

std::shared_ptr<const Source> with_tail(std::shared_ptr<const Source> capture,
                                        const std::vector<TailChunk>& tail) {
  if (tail.empty() || is_complete(*capture)) return capture;
  std::uint64_t begin = 0;
  try {
    begin = read_begin(capture, {}).data_begin;
  } catch (const FileError&) {
    return capture;  // no capture: who reads it says so
  }
  const Whole whole = whole_records(capture, begin);
  ByteBuffer out;
  for (const TailChunk& chunk : tail) {
    const std::uint32_t crc = crc32_of(chunk.records);
    if (!whole.chunks.contains({chunk.records.size(), crc})) append_chunk(out, chunk.records);
  }
  if (out.empty()) return capture;
  return std::make_shared<Appended>(std::move(capture), whole.end, std::move(out));
}

}  // namespace coop::mcap
