/// The messenger of the module hemitex_mpi.
#include <mpi.h>

#include <chrono>
#include <climits>
#include <cstdlib>
#include <list>
#include <stdexcept>
#include <thread>

#include "radiosity/ranks/messenger.h"

namespace hemitex::radiosity {
namespace {

class MpiMessenger final : public Messenger {
 public:
  MpiMessenger() {
    MPI_Init(nullptr, nullptr);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
  }
  /// Waits for the other ranks. MPI_Finalize also waits, but keeps a core busy meanwhile.
  ~MpiMessenger() override {
    MPI_Request allAreHere;
    MPI_Ibarrier(MPI_COMM_WORLD, &allAreHere);
    while (!isComplete(allAreHere)) {
      const std::optional<Message> message = receive();
      if (message && message->kind == MessageKind::Failed) abort(message->bytes.front());
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    for (Sending& sending : sending_) MPI_Wait(&sending.request, MPI_STATUS_IGNORE);
    MPI_Finalize();
  }
  MpiMessenger(const MpiMessenger&) = delete;
  MpiMessenger& operator=(const MpiMessenger&) = delete;

  int rank() const override { return rank_; }
  int ranks() const override { return ranks_; }

  void send(int to, MessageKind kind, std::string bytes) override {
    if (bytes.size() > INT_MAX) throw std::length_error("a message between ranks is longer than 2 GiB");
    forgetSent();
    Sending& sending = sending_.emplace_back(Sending{std::move(bytes), MPI_REQUEST_NULL});
    MPI_Isend(sending.bytes.data(), static_cast<int>(sending.bytes.size()), MPI_BYTE, to, static_cast<int>(kind),
              MPI_COMM_WORLD, &sending.request);
  }

  std::optional<Message> receive() override {
    forgetSent();
    int hasArrived = 0;
    MPI_Message arrived;
    MPI_Status status;
    MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &hasArrived, &arrived, &status);
    if (hasArrived == 0) return std::nullopt;
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    Message message{status.MPI_SOURCE, static_cast<MessageKind>(status.MPI_TAG), {}};
    message.bytes.resize(static_cast<std::size_t>(size));
    MPI_Mrecv(message.bytes.data(), size, MPI_BYTE, &arrived, MPI_STATUS_IGNORE);
    return message;
  }

  [[noreturn]] void abort(int exitCode) override {
    MPI_Abort(MPI_COMM_WORLD, exitCode);
    std::_Exit(exitCode);
  }

 private:
  /// A message whose bytes MPI may still read.
  struct Sending {
    std::string bytes;
    MPI_Request request;
  };

  static bool isComplete(MPI_Request& request) {
    int isComplete = 0;
    MPI_Test(&request, &isComplete, MPI_STATUS_IGNORE);
    return isComplete != 0;
  }
  void forgetSent() {
    sending_.remove_if([](Sending& sending) { return isComplete(sending.request); });
  }

  int rank_ = 0, ranks_ = 1;
  std::list<Sending> sending_;
};

std::unique_ptr<Messenger> start() { return std::make_unique<MpiMessenger>(); }

}  // namespace
}  // namespace hemitex::radiosity

extern "C" __attribute__((visibility("default")))
const hemitex::radiosity::MpiFunctions hemitexMpiFunctions = {hemitex::radiosity::start};
