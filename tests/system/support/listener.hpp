#pragma once
#include <chrono>
#include <string>

#include "runtime/dds_transport.hpp"
#include "runtime/node.hpp"

namespace coop::test {

/// A node of the test in the domain of a running system, which it hears as any other program would.
class Listener {
 public:
  explicit Listener(int domain, const std::string& name, bool reliable_streams = false)
      : Listener({.domain = domain,
                  .participant_name = name,
                  .partition = {},
                  .reliable_streams = reliable_streams,
                  .settings = runtime::read_dds_settings({})}) {}
  explicit Listener(const runtime::DdsOptions& dds)
      : transport_(dds),
        executor_(clock_),
        node_(options(dds.participant_name), transport_, clock_, executor_) {}

  [[nodiscard]] runtime::Node& node() { return node_; }
  /// Takes in what has arrived.
  void look() {
    transport_.mend();
    executor_.run_once();
  }
  /// The same, once something has arrived or `limit` has passed.
  void wait(std::chrono::milliseconds limit) { executor_.wait_and_run(limit); }

 private:
  static runtime::Options options(const std::string& name) {
    runtime::Options options;
    options.name = name;
    return options;
  }

  runtime::DdsTransport transport_;
  runtime::SystemClock clock_;
  runtime::Executor executor_;
  runtime::Node node_;
};

}  // namespace coop::test
