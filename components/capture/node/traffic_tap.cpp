#include "capture/node/traffic_tap.hpp"

#include <algorithm>

#include "capture/node/wire.hpp"

namespace coop::capture {

using runtime::DiscoveredEndpoint;
using runtime::DiscoveryEvent;
using runtime::RawSample;

namespace {

/// Samples kept for writers that discovery is about to tell of.
constexpr std::size_t kMostEarly = 1000;

}  // namespace

TrafficTap::TrafficTap(const runtime::DdsOptions& options, std::function<void()> wake,
                       Listener listener)
    : partition_(options.partition),
      listener_(std::move(listener)),
      wake_(std::move(wake)),
      participant_(options, [this] {
        has_news_ = true;
        wake_();
      }) {}

bool TrafficTap::handle_one() {
  if (participant_.mend()) has_news_ = true;
  if (!has_news_.exchange(false)) return false;
  for (const DiscoveryEvent& event : participant_.take_events()) take(event);
  return true;
}

void TrafficTap::take(const DiscoveryEvent& event) {
  const DiscoveredEndpoint& endpoint = event.endpoint;
  if (!endpoint.is_writer) return;
  if (event.kind == DiscoveryEvent::Kind::kLost) {
    unwanted_.erase(endpoint.id);
    const void* writer = nullptr;
    {
      const std::scoped_lock lock(mutex_);
      const auto route = routes_.find(endpoint.id);
      if (route == routes_.end()) return;
      writer = route->second.writer;
      routes_.erase(route);
    }
    listener_.on_gone(writer);
    return;
  }
  if (routes_.contains(endpoint.id) || !same_partition(partition_, endpoint.qos.partitions)) return;
  if (listener_.wants(endpoint)) {
    add(endpoint);
  } else {
    unwanted_[endpoint.id] = {endpoint.id.text(), endpoint.topic.name};
  }
}

void TrafficTap::add(const DiscoveredEndpoint& endpoint) {
  const runtime::WireQos wanted = runtime::reader_for(endpoint.qos);
  const auto [reader, is_new] = readers_.try_emplace(
      ReaderKey{endpoint.topic.name, endpoint.topic.type, wanted.reliable, wanted.transient_local});
  const void* const writer = listener_.on_writer(endpoint);
  {
    const std::scoped_lock lock(mutex_);
    routes_[endpoint.id] = {&reader->first, writer, endpoint.id.text()};
    // Within the lock, so that nothing newer overtakes them.
    for (const Early& one : early_) {
      if (one.sample.writer == endpoint.id && one.reader == &reader->first) {
        listener_.on_sample(writer, one.sample);
      }
    }
    std::erase_if(early_, [&](const Early& one) { return one.sample.writer == endpoint.id; });
  }
  if (!is_new) return;
  try {
    reader->second = participant_.create_reader(
        endpoint.topic, wanted,
        [this, key = &reader->first](RawSample&& sample) { receive(key, std::move(sample)); });
  } catch (const std::exception& problem) {
    {
      const std::scoped_lock lock(mutex_);
      routes_.erase(endpoint.id);
    }
    readers_.erase(reader);
    if (complained_.insert(endpoint.topic.name).second) listener_.on_problem(problem.what());
  }
}

void TrafficTap::receive(const ReaderKey* reader, RawSample&& sample) {
  const std::scoped_lock lock(mutex_);
  const auto route = routes_.find(sample.writer);
  if (route == routes_.end()) {
    if (early_.size() < kMostEarly) early_.push_back({reader, std::move(sample)});
  } else if (route->second.reader == reader) {
    listener_.on_sample(route->second.writer, sample);
  }
}

bool TrafficTap::is_heard(const runtime::EndpointId& id, const Route& route) const {
  const auto reader = readers_.find(*route.reader);
  return reader != readers_.end() && reader->second && reader->second->hears(id);
}

bool TrafficTap::hears_all(const std::vector<std::string>& writers) const {
  return std::ranges::all_of(writers, [this](const std::string& writer) {
    return std::ranges::any_of(unwanted_,
                               [&](const auto& entry) { return entry.second.id == writer; }) ||
           std::ranges::any_of(routes_, [&](const auto& entry) {
             return entry.second.id == writer && is_heard(entry.first, entry.second);
           });
  });
}

bool TrafficTap::hears_topic(const std::string& topic) const {
  return std::ranges::any_of(unwanted_,
                             [&](const auto& entry) { return entry.second.topic == topic; }) ||
         std::ranges::any_of(routes_, [&](const auto& entry) {
           return std::get<0>(*entry.second.reader) == topic && is_heard(entry.first, entry.second);
         });
}

}  // namespace coop::capture
