#include "runtime/lockstep/sample_gate.hpp"

#include <algorithm>
#include <limits>

namespace coop::runtime {

void SampleGate::admit(const std::string& writer, const WriterRank& rank, std::uint64_t base) {
  if (knows(writer)) return;
  Source source{.writer = writer, .rank = rank, .base = base, .held = {}};
  if (latched_) source.expected = base;
  const auto place = std::ranges::upper_bound(sources_, rank, {}, &Source::rank);
  sources_.insert(place, std::move(source));
  std::deque<Sample> strangers;
  strangers.swap(outside_);
  for (Sample& sample : strangers) hold(std::move(sample));
}

void SampleGate::keep_only(const std::vector<std::string>& writers) {
  std::erase_if(sources_, [&](const Source& source) {
    return std::ranges::find(writers, source.writer) == writers.end();
  });
}

bool SampleGate::knows(const std::string& writer) const {
  return std::ranges::find(sources_, writer, &Source::writer) != sources_.end();
}

void SampleGate::hold(Sample sample) {
  const auto source = std::ranges::find(sources_, sample.writer, &Source::writer);
  if (source == sources_.end()) {
    outside_.push_back(std::move(sample));
    return;
  }
  source->received = std::max(source->received, sample.sequence);
  if (!latched_ && sample.sequence <= source->base) return;
  source->held.push_back(std::move(sample));
}

void SampleGate::expect(const WriterRank& rank, std::uint64_t sequence) {
  const auto source = std::ranges::find(sources_, rank, &Source::rank);
  if (source != sources_.end()) source->expected = std::max(source->expected, sequence);
}

bool SampleGate::is_complete() const {
  return std::ranges::all_of(sources_, [this](const Source& source) {
    const std::uint64_t known = latched_ ? source.received : std::max(source.received, source.base);
    return known >= source.expected;
  });
}

std::string SampleGate::missing() const {
  for (const Source& source : sources_) {
    if (source.received >= source.expected) continue;
    return "sample " + std::to_string(source.expected) + " of " + source.rank.member + ", has " +
           std::to_string(source.received);
  }
  return {};
}

void SampleGate::forgo_missing() {
  for (Source& source : sources_) source.expected = std::min(source.expected, source.received);
}

void SampleGate::let_out(std::deque<Sample>& held, std::uint64_t up_to) {
  const auto end =
      std::ranges::find_if(held, [up_to](const Sample& sample) { return sample.sequence > up_to; });
  std::vector<std::string> newer;
  const auto first = static_cast<std::ptrdiff_t>(released_.size());
  // Newest first where older ones of the same instance are to be left out, then turned round.
  for (auto it = std::make_reverse_iterator(end); it != held.rend(); ++it) {
    if (latched_) {
      std::string key = type_.key_of(it->message.get());
      if (std::ranges::find(newer, key) != newer.end()) continue;
      newer.push_back(std::move(key));
    }
    released_.push_back(std::move(*it));
  }
  std::reverse(released_.begin() + first, released_.end());
  held.erase(held.begin(), end);
}

void SampleGate::release() {
  for (Source& source : sources_) let_out(source.held, source.expected);
  from_outside_ += outside_.size();
  for (Sample& sample : outside_) released_.push_back(std::move(sample));
  outside_.clear();
}

bool SampleGate::next(Sample& sample) {
  if (released_.empty()) return false;
  sample = std::move(released_.front());
  released_.pop_front();
  return true;
}

}  // namespace coop::runtime
