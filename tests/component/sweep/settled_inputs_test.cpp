#include "sweep/node/settled_inputs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "component/sweep/small_sweep.hpp"
#include "core/config/error.hpp"

namespace coop::sweep {
namespace {

using ::testing::HasSubstr;

class SettledInputs : public ::testing::Test {
 protected:
  /// What is said of a call with what `small_.sweep.inputs` now holds; empty where it may go on.
  [[nodiscard]] std::string refusal(bool is_task = false) const {
    try {
      settle_inputs(small_.sweep, is_task);
      return {};
    } catch (const config::Error& error) {
      return error.what();
    }
  }
  void rebuild_a_program() { small_.sweep.inputs["program dwa"] = "2"; }

  SmallSweep small_;
};

TEST_F(SettledInputs, TheSameInputsGoOn) {
  EXPECT_EQ(refusal(), "");
  small_.leave_result(small_.runs[0]);
  EXPECT_EQ(refusal(), "");
  EXPECT_EQ(refusal(true), "");
}

TEST_F(SettledInputs, ResultsOfOtherInputsAreNotAddedTo) {
  EXPECT_EQ(refusal(), "");
  small_.leave_result(small_.runs[0]);
  rebuild_a_program();
  EXPECT_THAT(refusal(), HasSubstr("(changed: program dwa); --restart"));
  EXPECT_THAT(refusal(), HasSubstr(small_.sweep.folder.string()));
}

TEST_F(SettledInputs, WhereNoRunSucceededThereIsNothingToMix) {
  EXPECT_EQ(refusal(), "");
  small_.leave_result(small_.runs[0], false);
  rebuild_a_program();
  EXPECT_EQ(refusal(), "");
  small_.leave_result(small_.runs[0]);
  EXPECT_EQ(refusal(), "") << "the new inputs are now the folder's";
}

TEST_F(SettledInputs, ATaskIsOfTheInputsOfTheCallThatSubmittedIt) {
  EXPECT_EQ(refusal(), "");
  rebuild_a_program();
  EXPECT_THAT(refusal(true), HasSubstr("program dwa")) << "though there is no result yet";
}

TEST_F(SettledInputs, ResultsOfUnknownInputsAreNotAddedTo) {
  small_.leave_result(small_.runs[0]);
  EXPECT_THAT(refusal(), HasSubstr("inputs.txt is missing"));
}

}  // namespace
}  // namespace coop::sweep
