/// Ranks that are threads of one process, for tests.
#pragma once

#include <deque>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "radiosity/ranks/messenger.h"

namespace hemitex::tests {

/// The messages that wait for each rank.
class Mailboxes {
 public:
  explicit Mailboxes(int ranks) : boxes_(static_cast<std::size_t>(ranks)) {}

  int ranks() const { return static_cast<int>(boxes_.size()); }
  void put(int to, radiosity::Message message) {
    const std::lock_guard lock(mutex_);
    boxes_[static_cast<std::size_t>(to)].push_back(std::move(message));
  }
  std::optional<radiosity::Message> take(int rank) {
    const std::lock_guard lock(mutex_);
    auto& box = boxes_[static_cast<std::size_t>(rank)];
    if (box.empty()) return std::nullopt;
    radiosity::Message message = std::move(box.front());
    box.pop_front();
    return message;
  }

 private:
  std::mutex mutex_;
  std::vector<std::deque<radiosity::Message>> boxes_;
};

class ThreadRank final : public radiosity::Messenger {
 public:
  ThreadRank(Mailboxes& boxes, int rank) : boxes_(boxes), rank_(rank) {}

  int rank() const override { return rank_; }
  int ranks() const override { return boxes_.ranks(); }
  void send(int to, radiosity::MessageKind kind, std::string bytes) override {
    boxes_.put(to, {rank_, kind, std::move(bytes)});
  }
  std::optional<radiosity::Message> receive() override { return boxes_.take(rank_); }
  [[noreturn]] void abort(int) override { throw std::logic_error("aborted"); }

 private:
  Mailboxes& boxes_;
  int rank_;
};

}  // namespace hemitex::tests
