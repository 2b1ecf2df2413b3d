#include <algorithm>
#include <tuple>

#include "capture/mcap/reader_state.hpp"

namespace coop::mcap {
namespace {

/// A chunk or a run of loose messages: what is read as a whole.
struct Block {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  Nanoseconds start_time = 0;
  Nanoseconds end_time = 0;
  bool is_chunk = true;
};

/// A block whose turn has come: where its messages are that are wanted, in the order wanted.
struct OpenBlock {
  Block block;
  std::vector<MessageIndexEntry> entries;
  std::size_t next = 0;
  std::shared_ptr<const std::vector<std::byte>> records;  // null: to be read again
};

}  // namespace

class MessageCursor::Merge {
 public:
  Merge(std::shared_ptr<ReaderState> state, Selection selection)
      : state_(std::move(state)), selection_(std::move(selection)) {
    collect_blocks();
  }

  std::optional<ReadMessage> next() {
    open_due_blocks();
    if (heap_.empty()) return std::nullopt;
    const Head head = heap_.top();
    heap_.pop();
    OpenBlock& open = *open_[head.slot];
    if (!open.records) {
      open.records = read(open.block);
      keep_within_cache(head.slot);
    }
    current_ = open.records;
    const MessageIndexEntry entry = open.entries[open.next];
    if (++open.next < open.entries.size()) {
      push(head.slot);
    } else {
      open_[head.slot].reset();
    }
    return message_at(head.block_offset, entry);
  }

 private:
  /// The next message of an open block.
  struct Head {
    Nanoseconds time = 0;  // 0 for all when the file's order is wanted
    std::uint64_t block_offset = 0;
    std::size_t slot = 0;
    friend bool operator>(const Head& a, const Head& b) {
      return std::tie(a.time, a.block_offset) > std::tie(b.time, b.block_offset);
    }
  };

  [[nodiscard]] bool by_time() const { return selection_.order == Order::kLogTime; }

  void collect_blocks() {
    for (const ChunkIndex& chunk : state_->summary.chunks) {
      if (!in_time(chunk.message_start_time, chunk.message_end_time) || !has_wanted(chunk))
        continue;
      blocks_.push_back({chunk.chunk_start_offset, chunk.chunk_length, chunk.message_start_time,
                         chunk.message_end_time, true});
    }
    for (const LooseRun& run : state_->summary.loose) {
      if (!in_time(run.start_time, run.end_time)) continue;
      blocks_.push_back({run.offset, run.length, run.start_time, run.end_time, false});
    }
    std::ranges::sort(blocks_, [&](const Block& a, const Block& b) {
      if (by_time() && a.start_time != b.start_time) return a.start_time < b.start_time;
      return a.offset < b.offset;
    });
  }

  [[nodiscard]] bool in_time(Nanoseconds start, Nanoseconds end) const {
    return end >= selection_.start && (start <= selection_.end);
  }

  /// False only if the chunk's index names all its channels and none is wanted.
  bool has_wanted(const ChunkIndex& chunk) {
    if (selection_.topics.empty() || chunk.message_index_offsets.empty()) return true;
    return std::ranges::any_of(chunk.message_index_offsets, [&](const auto& channel) {
      const auto known = state_->summary.channels.find(channel.first);
      return known == state_->summary.channels.end() || is_wanted(known->second);
    });
  }

  [[nodiscard]] bool is_wanted(const Channel& channel) const {
    return selection_.topics.empty() || std::ranges::count(selection_.topics, channel.topic) > 0;
  }

  bool is_wanted(std::uint16_t id) {
    if (id >= wanted_.size()) wanted_.resize(std::size_t{id} + 1);
    std::optional<bool>& known = wanted_[id];
    if (!known) {
      const Channel* channel = state_->channel(id);
      if (channel == nullptr) {
        throw FileError(now_reading_, "a message of channel " + std::to_string(id) +
                                          ", which the file does not describe");
      }
      known = is_wanted(*channel);
    }
    return *known;
  }

  void open_due_blocks() {
    while (next_block_ < blocks_.size()) {
      const Block& block = blocks_[next_block_];
      const bool due = heap_.empty() || (by_time() && block.start_time <= heap_.top().time);
      if (!due) return;
      ++next_block_;
      open(block);
    }
  }

  void open(const Block& block) {
    auto open = std::make_unique<OpenBlock>();
    open->block = block;
    open->records = read(block);
    now_reading_ = block.offset;
    RecordCursor cursor(*open->records, 0, block.offset);
    RawRecord record;
    while (cursor.next(record)) {
      if (record.opcode != Opcode::kMessage) continue;
      const Message message = decode_message({record.opcode, block.offset, record.content});
      if (!selection_.has(message.log_time) || !is_wanted(message.channel_id)) continue;
      open->entries.push_back({message.log_time, record.offset});
    }
    if (open->entries.empty()) return;
    const auto earlier = [](const auto& a, const auto& b) { return a.log_time < b.log_time; };
    if (by_time() && !std::ranges::is_sorted(open->entries, earlier)) {
      std::ranges::stable_sort(open->entries, earlier);
    }
    auto slot =
        static_cast<std::size_t>(std::ranges::find_if(open_, std::logical_not<>()) - open_.begin());
    if (slot == open_.size()) open_.emplace_back();
    open_[slot] = std::move(open);
    push(slot);
    keep_within_cache(slot);
  }

  void push(std::size_t slot) {
    const OpenBlock& open = *open_[slot];
    heap_.push({by_time() ? open.entries[open.next].log_time : 0, open.block.offset, slot});
  }

  /// Lets go of the records of those blocks whose turn comes last.
  void keep_within_cache(std::size_t keep) {
    while (true) {
      std::uint64_t held = 0;
      OpenBlock* last = nullptr;
      for (std::size_t slot = 0; slot < open_.size(); ++slot) {
        OpenBlock* open = open_[slot].get();
        if (open == nullptr || !open->records) continue;
        held += open->records->size();
        const bool later = last == nullptr ||
                           open->entries[open->next].log_time > last->entries[last->next].log_time;
        if (slot != keep && later) last = open;
      }
      if (held <= state_->limits.chunk_cache || last == nullptr) return;
      last->records.reset();
    }
  }

  [[nodiscard]] std::shared_ptr<const std::vector<std::byte>> read(const Block& block) {
    auto records = std::make_shared<std::vector<std::byte>>();
    if (!block.is_chunk) {
      records->resize(static_cast<std::size_t>(block.length));
      state_->source->read(block.offset, *records);
      return records;
    }
    const RawRecord record =
        state_->read_record(Opcode::kChunk, block.offset, block.length, state_->compressed);
    state_->decompressor.decompress(decode_chunk(record), block.offset, state_->limits.max_chunk,
                                    *records);
    return records;
  }

  ReadMessage message_at(std::uint64_t block_offset, const MessageIndexEntry& entry) {
    if (entry.offset > current_->size()) {
      throw FileError(block_offset, "it has changed while it was read");
    }
    RecordCursor cursor(Bytes(*current_).subspan(static_cast<std::size_t>(entry.offset)), 0,
                        block_offset);
    RawRecord record;
    if (!cursor.next(record)) throw FileError(block_offset, "it has changed while it was read");
    ReadMessage result;
    result.message = decode_message({record.opcode, block_offset, record.content});
    result.channel = state_->channel(result.message.channel_id);
    if (result.channel == nullptr)
      throw FileError(block_offset, "it has changed while it was read");
    result.schema = state_->summary.schema_of(*result.channel);
    return result;
  }

  std::shared_ptr<ReaderState> state_;
  Selection selection_;
  std::vector<Block> blocks_;
  std::size_t next_block_ = 0;
  std::vector<std::unique_ptr<OpenBlock>> open_;
  std::priority_queue<Head, std::vector<Head>, std::greater<>> heap_;
  std::vector<std::optional<bool>> wanted_;
  std::uint64_t now_reading_ = 0;
  std::shared_ptr<const std::vector<std::byte>> current_;

  friend class MessageCursor;
};

MessageCursor::MessageCursor(std::shared_ptr<ReaderState> state, Selection selection)
    : merge_(std::make_unique<Merge>(std::move(state), std::move(selection))) {}
MessageCursor::~MessageCursor() = default;
MessageCursor::MessageCursor(MessageCursor&&) noexcept = default;
MessageCursor& MessageCursor::operator=(MessageCursor&&) noexcept = default;

std::optional<ReadMessage> MessageCursor::next() {
  return naming_file(*merge_->state_->source, [&] { return merge_->next(); });
}

}  // namespace coop::mcap
