// Checks by its pictures whether a worker follows the protocol (compiler/adapters/PROTOCOL.md), and explains
// what is wrong.
#pragma once

#include <string>
#include <vector>

#include "worker/worker.hpp"

namespace remapc {

// One result of the check. (Finding is that of tables, table/check.hpp.)
struct WorkerFinding {
  enum class Verdict {
    kGood,
    kRemark,  // allowed by the protocol, but worth knowing
    kWrong,
  };
  std::string model;
  std::string check;  // `orientation`, `light scale`, ...
  Verdict verdict = Verdict::kGood;
  std::string words;  // what was found and what is wrong with it
};

// Requests pictures of all models of `worker`, `resolution` pixels a side and three times that. A picture
// that fails is a finding too; it ends the checks of its model.
std::vector<WorkerFinding> check_worker(Worker& worker, int resolution);

}  // namespace remapc
