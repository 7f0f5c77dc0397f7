// Converts the assets of a list.
#pragma once

#include <functional>
#include <vector>

#include "texremap/asset_jobs.hpp"
#include "texremap/asset_report.hpp"
#include "texremap/convert_options.hpp"
#include "texremap/journal.hpp"

namespace remap {

// What the results of a run depend on besides the assets.
ConversionNote conversion_of_assets(const ConvertOptions& options);

// `conversion`: that of the options. `finished` is called for each asset as it is finished, by one thread at
// a time. Of several assets a failing one does not stop the others; the failure of a single one is thrown.
// Reports are in the order of the list.
std::vector<AssetReport> run_assets(const AssetList& list, const ConvertOptions& options,
                                    const ConversionNote& conversion,
                                    const std::function<void(const AssetReport&)>& finished);

}  // namespace remap
