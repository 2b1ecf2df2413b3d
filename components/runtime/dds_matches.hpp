#pragma once
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>

namespace coop::runtime {

/// An endpoint's id, as in Sample::writer.
[[nodiscard]] std::string identity(const eprosima::fastrtps::rtps::GUID_t& guid);

/// The counterparts an endpoint is matched with at present. Told by listener threads.
class Matches {
 public:
  explicit Matches(std::weak_ptr<std::function<void()>> on_match)
      : on_match_(std::move(on_match)) {}
  void change(const eprosima::fastrtps::rtps::InstanceHandle_t& counterpart, int change);
  void clear();
  [[nodiscard]] bool contains(const std::string& id) const;
  [[nodiscard]] int count() const;

 private:
  std::weak_ptr<std::function<void()>> on_match_;
  mutable std::mutex mutex_;
  std::set<std::string> counterparts_;
};

class ReaderListener : public eprosima::fastdds::dds::DataReaderListener {
 public:
  ReaderListener(std::function<void()> on_data, std::weak_ptr<std::function<void()>> on_match)
      : matches(std::move(on_match)), on_data_(std::move(on_data)) {}
  void on_data_available(eprosima::fastdds::dds::DataReader*) override { on_data_(); }
  void on_subscription_matched(
      eprosima::fastdds::dds::DataReader*,
      const eprosima::fastdds::dds::SubscriptionMatchedStatus& status) override {
    matches.change(status.last_publication_handle, status.current_count_change);
  }
  Matches matches;

 private:
  std::function<void()> on_data_;
};

class WriterListener : public eprosima::fastdds::dds::DataWriterListener {
 public:
  explicit WriterListener(std::weak_ptr<std::function<void()>> on_match)
      : matches(std::move(on_match)) {}
  void on_publication_matched(
      eprosima::fastdds::dds::DataWriter*,
      const eprosima::fastdds::dds::PublicationMatchedStatus& status) override {
    matches.change(status.last_subscription_handle, status.current_count_change);
  }
  Matches matches;
};

}  // namespace coop::runtime
