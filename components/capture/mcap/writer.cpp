#include "capture/mcap/writer.hpp"

#include <algorithm>
#include <bit>

#include "capture/mcap/ring_folder.hpp"

namespace coop::mcap {
namespace {

std::unique_ptr<Tail> make_tail(const std::filesystem::path& capture, bool wanted) {
  if (!wanted) return nullptr;
  try {
    return std::make_unique<Tail>(Tail::path_of(capture));
  } catch (const std::system_error&) {
    return nullptr;  // without it a kill costs what is in memory
  }
}

}  // namespace

std::uint64_t WriterStatus::lost() const {
  std::uint64_t sum = 0;
  for (const auto& [channel, count] : lost_messages) sum += count;
  return sum;
}

Writer::Writer(const Series& series, const WriterOptions& options)
    : options_(options),
      target_(make_series(series, options.file, definitions_)),
      tail_(make_tail(series.path, options.tail)),
      compressor_(options.compression, options.level) {
  start();
}

Writer::Writer(const Ring& ring, const WriterOptions& options)
    : options_(options),
      target_(make_ring(ring, options.file, definitions_)),
      tail_(make_tail(ring.folder / RingFolder::kTailOf, options.tail && !ring.folder.empty())),
      is_ring_(true),
      compressor_(options.compression, options.level) {
  start();
}

Writer::~Writer() {
  close();
}

void Writer::start() {
  status_.files = target_->files();
  status_.warning = target_->warning();
  thread_ = std::thread([this] { run(); });
}

std::uint16_t Writer::add_schema(std::string_view name, std::string_view encoding,
                                 std::string_view data) {
  return definitions_.schema(name, encoding, data);
}

std::uint16_t Writer::add_channel(std::uint16_t schema_id, std::string_view topic,
                                  std::string_view message_encoding,
                                  const std::map<std::string, std::string>& metadata) {
  const auto id = definitions_.channel(schema_id, topic, message_encoding, metadata);
  has_new_definitions_ = true;
  return id;
}

/// A chunk that is found in the tail must tell of its channels itself: those in the file come with
/// the next chunk.
void Writer::collect_definitions() {
  if (!tail_ || !has_new_definitions_.exchange(false)) return;
  const Definitions::View fresh = definitions_.after(schemas_told_, channels_told_);
  const Padding padding = options_.file.layout.padding;
  for (const Schema* schema : fresh.schemas) encode(untold_, *schema, padding);
  for (const Channel* channel : fresh.channels) encode(untold_, *channel, padding);
  schemas_told_ += fresh.schemas.size();
  channels_told_ += fresh.channels.size();
}

bool Writer::write(const Message& message) {
  std::unique_lock lock(mutex_);
  if (!make_room(lock, message)) {
    ++status_.lost_messages[message.channel_id];
    return false;
  }
  current_->add_records(untold_.view());
  untold_.clear();
  current_->add(message);
  ++status_.messages;
  if (current_->size() >= options_.chunk_bytes) hand_over();
  return true;
}

/// A chunk that has room for the message, and for the definitions before it.
bool Writer::make_room(std::unique_lock<std::mutex>& lock, const Message& message) {
  while (!closed_ && !failed_) {
    collect_definitions();
    const std::size_t size = untold_.size() + kRecordPrefix + kMessagePrefix + message.data.size();
    if (current_) {
      const bool too_large = current_->size() + size > options_.chunk_bytes;
      const bool too_old = message.log_time >= current_->start_time() + options_.chunk_age;
      if (too_large || too_old) hand_over();
    }
    if (current_ || take_builder(std::max(options_.chunk_bytes, size))) return true;
    if (options_.when_full == WhenFull::kLose) return false;
    has_room_.wait(lock);
  }
  return false;
}

/// The smallest free builder that has the capacity wanted, or a new one, in place of a smaller one
/// where there is one. At least two there are always, so that one may be filled while the other is
/// written.
bool Writer::take_builder(std::size_t capacity) {
  std::ranges::sort(free_, {}, [](const auto& builder) { return builder->capacity(); });
  const auto fitting = std::ranges::lower_bound(
      free_, capacity, {}, [](const auto& builder) { return builder->capacity(); });
  if (fitting != free_.end()) {
    current_ = std::move(*fitting);
    free_.erase(fitting);
    return true;
  }
  if (!free_.empty()) drop_smallest();
  if (capacity > options_.chunk_bytes) capacity = std::bit_ceil(capacity);
  while (builders_ >= 2 && builder_bytes_ + capacity > options_.queue_bytes) {
    if (free_.empty()) return false;
    drop_smallest();
  }
  current_ = std::make_unique<ChunkBuilder>(options_.file.layout.padding,
                                            tail_ ? tail_->add_slot(capacity) : nullptr);
  current_->reserve(capacity);
  ++builders_;
  builder_bytes_ += current_->capacity();
  return true;
}

void Writer::drop_smallest() {
  builder_bytes_ -= free_.front()->capacity();
  --builders_;
  free_.erase(free_.begin());
}

void Writer::hand_over() {
  if (!current_ || current_->empty()) return;
  jobs_.push_back({std::move(current_), nullptr});
  has_job_.notify_one();
}

void Writer::close_aged_chunk(Nanoseconds now) {
  const std::lock_guard lock(mutex_);
  if (current_ && !current_->empty() && now >= current_->start_time() + options_.chunk_age) {
    hand_over();
  }
}

void Writer::post(std::function<void()> command) {
  jobs_.push_back({nullptr, std::move(command)});
  has_job_.notify_one();
}

void Writer::attach(const Attachment& attachment, Where where) {
  auto stored = std::make_shared<StoredAttachment>();
  stored->attachment = attachment;
  stored->data.assign(attachment.data.begin(), attachment.data.end());
  stored->attachment.data = stored->data;
  const std::lock_guard lock(mutex_);
  if (closed_) return;
  post([this, stored, where] { target_->add(stored, where); });
}

void Writer::add(const Metadata& metadata, Where where) {
  const std::lock_guard lock(mutex_);
  if (closed_) return;
  post([this, metadata, where] { target_->add(metadata, where); });
}

void Writer::begin_anew(const std::filesystem::path& path) {
  const std::lock_guard lock(mutex_);
  if (closed_) return;
  hand_over();
  schemas_told_ = channels_told_ = 0;
  untold_.clear();
  has_new_definitions_ = true;
  post([this, path] {
    target_->begin_anew(path);
    if (tail_ && !is_ring_) tail_->rename(Tail::path_of(path));
  });
}

void Writer::flush() {
  std::promise<void> done;
  {
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    hand_over();
    post([&done] { done.set_value(); });
  }
  done.get_future().wait();
}

std::future<std::uint64_t> Writer::snapshot(const std::filesystem::path& path) {
  auto result = std::make_shared<std::promise<std::uint64_t>>();
  std::future<std::uint64_t> future = result->get_future();
  const std::lock_guard lock(mutex_);
  if (closed_) {
    result->set_exception(std::make_exception_ptr(std::logic_error("the capture is closed")));
    return future;
  }
  hand_over();
  post([this, result, path] {
    try {
      result->set_value(target_->write_snapshot(path));
    } catch (...) {
      result->set_exception(std::current_exception());
    }
  });
  return future;
}

void Writer::close() {
  {
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    hand_over();
    closed_ = true;
    has_job_.notify_one();
    has_room_.notify_all();
  }
  thread_.join();
}

WriterStatus Writer::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

void Writer::note_failure(const std::string& what) {
  const std::lock_guard lock(mutex_);
  failed_ = true;
  if (status_.error.empty()) status_.error = what;
  has_room_.notify_all();
}

void Writer::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    has_job_.wait(lock, [&] { return closed_ || !jobs_.empty(); });
    if (jobs_.empty()) break;
    Job job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    try {
      if (job.chunk) {
        run_chunk(std::move(job.chunk));
      } else {
        job.command();
      }
    } catch (const std::exception& error) {
      note_failure(error.what());
    }
    lock.lock();
    status_.bytes = target_->bytes();
    status_.files = target_->files();
    status_.warning = target_->warning();
  }
  lock.unlock();
  try {
    target_->finish();
  } catch (const std::exception& error) {
    note_failure(error.what());
  }
  if (tail_) tail_->remove();
  lock.lock();
  status_.bytes = target_->bytes();
}

void Writer::run_chunk(std::unique_ptr<ChunkBuilder> chunk) {
  std::string failure;
  try {
    target_->add(make_ready(*chunk, compressor_, compressed_));
  } catch (const std::exception& error) {
    failure = error.what();
  }
  if (!failure.empty()) note_failure(failure);
  const std::lock_guard lock(mutex_);
  if (!failure.empty()) {
    for (const ChannelEntries& channel : chunk->channels()) {
      status_.lost_messages[channel.channel_id] += channel.entries.size();
    }
  }
  chunk->clear();
  free_.push_back(std::move(chunk));
  has_room_.notify_all();
}

}  // namespace coop::mcap
