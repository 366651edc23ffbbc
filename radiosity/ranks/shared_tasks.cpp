#include "radiosity/ranks/shared_tasks.h"

#include <chrono>
#include <map>
#include <thread>

#include "radiosity/base/bytes.h"

namespace hemitex::radiosity {
namespace {

/// Tasks that a rank holds: the one that it computes and the next ones, so that it does not wait for messages. MPI
/// delivers a large result only when the rank sends the next one.
constexpr std::size_t tasksPerRank = 3;

std::string bytesOf(std::size_t task, const std::string& result = {}) {
  std::string bytes;
  appendBytes(bytes, std::uint64_t{task});
  return bytes + result;
}

/// The work of rank 0.
class HandingOut {
 public:
  HandingOut(Messenger& ranks, const SharedTasks& tasks) : ranks_(ranks), tasks_(tasks), next_(tasks.first) {}

  void run() {
    for (std::size_t k = 0; k < tasksPerRank; ++k)
      for (int rank = 1; rank < ranks_.ranks(); ++rank) giveTask(rank);
    while (taken_ < tasks_.end) {
      takeMessages();
      if (const auto result = results_.find(taken_); result != results_.end()) {
        tasks_.take(taken_++, result->second);
        results_.erase(result);
      } else {
        computeOne();
      }
    }
    endTasks(ranks_);
  }

 private:
  void giveTask(int rank) {
    if (next_ < tasks_.end) ranks_.send(rank, MessageKind::Task, bytesOf(next_++));
  }
  void takeMessages() {
    while (const auto message = received(ranks_)) {
      std::string_view result = message->bytes;
      const std::size_t task = takeValue<std::uint64_t>(result);
      keep(task, std::string(result));
      giveTask(message->from);
    }
  }
  /// The next task, or the first one whose result has not arrived.
  void computeOne() {
    const std::size_t task = next_ < tasks_.end ? next_++ : taken_;
    keep(task, tasks_.compute(task));
  }
  void keep(std::size_t task, std::string result) {
    if (task >= taken_) results_.insert_or_assign(task, std::move(result));
  }

  Messenger& ranks_;
  const SharedTasks& tasks_;
  std::size_t next_;
  std::size_t taken_ = tasks_.first;
  std::map<std::size_t, std::string> results_;  ///< computed, but not taken
};

}  // namespace

std::optional<Message> received(Messenger& ranks) {
  std::optional<Message> message = ranks.receive();
  if (message && message->kind == MessageKind::Failed)
    throw RankError(message->bytes.front(), message->bytes.substr(1));
  return message;
}

Message awaited(Messenger& ranks) {
  constexpr int looks = 100;  // before the first sleep
  constexpr std::chrono::microseconds pause(50);
  for (int look = 0;; ++look) {
    if (std::optional<Message> message = received(ranks)) return *std::move(message);
    if (look >= looks) std::this_thread::sleep_for(pause);
  }
}

void endTasks(Messenger& ranks) {
  for (int rank = 1; rank < ranks.ranks(); ++rank) ranks.send(rank, MessageKind::Over, {});
  for (int working = ranks.ranks() - 1; working > 0;)
    if (awaited(ranks).kind == MessageKind::Done) --working;
}

void answerTasks(Messenger& ranks, const std::function<std::string(std::string_view task)>& answer) {
  for (Message message = awaited(ranks); message.kind != MessageKind::Over; message = awaited(ranks))
    ranks.send(0, MessageKind::Result, answer(message.bytes));
  ranks.send(0, MessageKind::Done, {});
}

void run(Messenger* ranks, const SharedTasks& tasks) {
  if (ranks == nullptr)
    for (std::size_t task = tasks.first; task < tasks.end; ++task) tasks.take(task, tasks.compute(task));
  else if (ranks->rank() == 0)
    HandingOut(*ranks, tasks).run();
  else
    answerTasks(*ranks, [&tasks](std::string_view bytes) {
      const std::size_t task = takeValue<std::uint64_t>(bytes);
      return bytesOf(task, tasks.compute(task));
    });
}

}  // namespace hemitex::radiosity
