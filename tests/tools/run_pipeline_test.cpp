#include "run_pipeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <new>
#include <set>
#include <stdexcept>
#include <string>

#include "exit_code.h"

namespace lascaux {
namespace {

constexpr const char* kBlob =
    "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 100 60'><path fill='none' stroke='black' "
    "d='M 10 30 C 10 5 90 5 90 30 C 90 55 10 55 10 30 Z'/></svg>";

PipelineOptions Small() {
  PipelineOptions options;
  options.resolution = 48;
  return options;
}

TEST(RunPipeline, AClosedOutlineBecomesOneSolidOnTheGround) {
  const Model model = RunPipeline(kBlob, Small());
  ASSERT_FALSE(HasError(model.diagnostics)) << model.diagnostics.back().message;
  EXPECT_TRUE(model.facts->IsPrintable());
  ASSERT_TRUE(model.fidelity);
  EXPECT_GT(model.fidelity->iou, 0.97);
  float lowest = 1e9f;
  for (const auto& vertex : model.mesh->vertices) lowest = std::min(lowest, vertex.y());
  EXPECT_EQ(lowest, 0);
  EXPECT_FALSE(model.preview);
}

TEST(RunPipeline, GoesAsFarAsItIsAsked) {
  PipelineOptions options = Small();
  options.last = LastStage::kCreature;
  const Model understood = RunPipeline(kBlob, options);
  EXPECT_TRUE(understood.creature);
  EXPECT_FALSE(understood.grid);
  options.last = LastStage::kPreview;
  EXPECT_TRUE(RunPipeline(kBlob, options).preview);
}

TEST(RunPipeline, TellsWhatIsReadyBesideTheCheck) {
  PipelineOptions options = Small();
  options.keep_level_set = false;
  for (const LastStage last : {LastStage::kCreature, LastStage::kMesh, LastStage::kPreview}) {
    options.last = last;
    std::mutex telling;
    std::set<Ready> told;
    const Model model = RunPipeline(kBlob, options, {}, [&](const Model& made, Ready ready) {
      const std::lock_guard lock(telling);
      EXPECT_TRUE(told.insert(ready).second);
      EXPECT_TRUE(made.grid || ready != Ready::kLevelSet);
      EXPECT_TRUE(made.mesh);
      EXPECT_TRUE(made.preview || ready == Ready::kLevelSet || ready == Ready::kMesh);
    });
    ASSERT_FALSE(HasError(model.diagnostics));
    switch (last) {
      case LastStage::kMesh:
        EXPECT_EQ(told, (std::set{Ready::kLevelSet, Ready::kMesh}));
        EXPECT_FALSE(model.grid);
        break;
      case LastStage::kPreview:
        EXPECT_EQ(told, (std::set{Ready::kLevelSet, Ready::kMesh, Ready::kPreview, Ready::kAll}));
        break;
      default:
        EXPECT_TRUE(told.empty());
    }
  }
}

TEST(RunPipeline, StopsAtTheFirstErrorAndKeepsWhatWasFound) {
  PipelineOptions options = Small();
  options.depth.body = Eigen::Vector2d(1000, 1000);
  const Model model = RunPipeline(kBlob, options);
  EXPECT_TRUE(HasError(model.diagnostics));
  EXPECT_TRUE(model.parts);
  EXPECT_FALSE(model.graph);
  EXPECT_FALSE(model.mesh);
}

TEST(RunPipeline, ARaisedFlagIsAnInterrupt) {
  const std::atomic<bool> flag = true;
  const Model model = RunPipeline(kBlob, Small(), {.threads = 1, .cancel = &flag, .progress = {}});
  ASSERT_TRUE(HasError(model.diagnostics));
  EXPECT_EQ(model.diagnostics.back().code, "cancelled");
  EXPECT_EQ(ExitCodeOf(model.diagnostics), ExitCode::kInterrupted);
}

TEST(RunPipeline, NothingThatIsThrownEscapes) {
  Execution execution;
  execution.progress = [](auto, double) { throw std::runtime_error("a library gave up"); };
  const Model failed = RunPipeline(kBlob, Small(), execution);
  EXPECT_EQ(failed.diagnostics.back().code, "internal-error");
  EXPECT_EQ(ExitCodeOf(failed.diagnostics), ExitCode::kBug);
  execution.progress = [](std::string_view stage, double) {
    if (stage == "filling the volume") throw std::bad_alloc();
  };
  const Model full = RunPipeline(kBlob, Small(), execution);
  EXPECT_EQ(full.diagnostics.back().code, "out-of-memory");
  EXPECT_EQ(ExitCodeOf(full.diagnostics), ExitCode::kUsage);
  EXPECT_NE(full.diagnostics.back().message.find("GB"), std::string::npos);
}

}  // namespace
}  // namespace lascaux
