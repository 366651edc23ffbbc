/// Divides tasks among ranks. A result is a pure function of its task, so it does not matter which rank computes it.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "radiosity/ranks/messenger.h"

namespace hemitex::radiosity {

/// As Messenger::receive, but throws RankError for the message of a rank that failed.
std::optional<Message> received(Messenger& ranks);
/// Waits for a message; throws RankError. Sleeps between looks, so that ranks that wait leave the cores to ranks that
/// work.
Message awaited(Messenger& ranks);
/// On rank 0: tells the other ranks that there are no more tasks, and waits until they know. Late results are ignored.
void endTasks(Messenger& ranks);
/// On other ranks: sends rank 0 the answer to each task, given its bytes, until there are no more.
void answerTasks(Messenger& ranks, const std::function<std::string(std::string_view task)>& answer);

/// Computes the results of the tasks [first, end). Rank 0 hands out a task whenever a rank has sent a result, computes
/// tasks itself meanwhile, and calls `take` in the order of tasks. It repeats tasks of slow ranks rather than wait for
/// them. On other ranks, computes until rank 0 has all results; the other arguments are ignored there. `ranks` may be
/// null: then this process computes all.
struct SharedTasks {
  std::size_t first = 0, end = 0;
  std::function<std::string(std::size_t task)> compute;
  std::function<void(std::size_t task, const std::string& result)> take;
};
void run(Messenger* ranks, const SharedTasks& tasks);

}  // namespace hemitex::radiosity
