/// Messages between the ranks of a parallel run: processes that compute one result together, on one machine or many.
/// Rank 0 reads the command, hands out work and writes results; the other ranks compute. MPI implements the interface,
/// and tests implement it with threads. Programs open the module hemitex_mpi, which is the only code that links MPI,
/// when they run with several ranks.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace hemitex::radiosity {

enum class MessageKind {
  Task,      ///< from rank 0: what to compute
  Result,    ///< to rank 0: what was computed
  Over,      ///< from rank 0: there are no more tasks
  Done,      ///< to rank 0: the answer to `Over`, the last message about these tasks
  Solution,  ///< from rank 0: the radiosity of a solution
  Failed,    ///< to rank 0: an error, which ends all ranks (see RankError)
};

struct Message {
  int from = 0;  ///< rank
  MessageKind kind = MessageKind::Task;
  std::string bytes;
};

/// An error of another rank, thrown on rank 0.
class RankError : public std::runtime_error {
 public:
  RankError(int code, const std::string& text) : std::runtime_error(text), exitCode(code) {}
  int exitCode;
};

/// One rank's access to the others. Only one thread uses it.
class Messenger {
 public:
  virtual ~Messenger() = default;

  virtual int rank() const = 0;
  /// The number of ranks, at least 1.
  virtual int ranks() const = 0;
  /// Sends a message and returns at once; throws std::length_error above 2 GiB. Messages from one rank to another
  /// arrive in their order.
  virtual void send(int to, MessageKind kind, std::string bytes) = 0;
  /// The next message that has arrived; nothing if there is none.
  virtual std::optional<Message> receive() = 0;
  /// Ends all ranks at once. Their launcher exits with this code.
  [[noreturn]] virtual void abort(int exitCode) = 0;
};

/// What the module exports under the name `hemitexMpiFunctions`.
struct MpiFunctions {
  /// Starts MPI. The destructor of the result ends it; all ranks must reach that. At most one result per process.
  std::unique_ptr<Messenger> (*start)();
};

/// Opens the module and starts MPI. Throws InputError where hemitex was built without MPI or its libraries are missing.
std::unique_ptr<Messenger> startMpi();

}  // namespace hemitex::radiosity
