// Why a plan runs a stage or leaves the stage out: one function for each stage, in pipeline order.
#pragma once

#include "host/plan/stages.h"

namespace tessera::plan {

Need needClear(const PlanFacts& facts);
Need needTransform(const PlanFacts& facts);
Need needProject(const PlanFacts& facts);
Need needSetup(const PlanFacts& facts);
Need needPayload(const PlanFacts& facts);
Need needBinCount(const PlanFacts& facts);
Need needScanBlocks(const PlanFacts& facts);
Need needScanAdd(const PlanFacts& facts);
Need needBinInsert(const PlanFacts& facts);
Need needRasterTiles(const PlanFacts& facts);
Need needRasterItems(const PlanFacts& facts);
Need needResolve(const PlanFacts& facts);
Need needShade(const PlanFacts& facts);
Need needAttribute(const PlanFacts& facts);

}  // namespace tessera::plan
