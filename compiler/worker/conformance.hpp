// Whether a worker does what the protocol asks (compiler/adapters/PROTOCOL.md), found from its pictures and
// said in words.
#pragma once

#include <string>
#include <vector>

#include "worker/worker.hpp"

namespace remapc {

// Not Finding, which is that of tables (table/check.hpp).
struct WorkerFinding {
  enum class Verdict {
    kGood,
    kRemark,  // within the protocol, worth knowing
    kWrong,
  };
  std::string model;
  std::string check;  // `orientation`, `light scale`, ...
  Verdict verdict = Verdict::kGood;
  std::string words;  // what was found; what is wrong with it
};

// Asks `worker` for pictures of all its models, `resolution` pixels a side (and three times that). A picture
// that cannot be had is a finding too, and ends the checks of that model.
std::vector<WorkerFinding> check_worker(Worker& worker, int resolution);

}  // namespace remapc
