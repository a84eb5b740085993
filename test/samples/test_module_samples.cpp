// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "program.hpp"

namespace opencv_test { namespace {

TEST(ModuleSamples, correct_frame)
{
    const TemporaryFolder folder;
    const std::string raw = streetFolder() + "/rolling.png";
    const Outcome outcome =
        runProgram(CORRECT_FRAME_PROGRAM, {raw, folder / "corrected.png", folder / "overlay.png", "--focal=816",
                                           "--speed=60", "--yaw_rate=40", "--wall=2.5"});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    EXPECT_NE(std::string::npos, outcome.output.find("Without sensors: status 0")) << outcome.output;
    EXPECT_NE(std::string::npos, outcome.output.find("With sensors: status 0")) << outcome.output;

    const cv::Mat before = cv::imread(raw), corrected = cv::imread(folder / "corrected.png"),
                  overlay = cv::imread(folder / "overlay.png");
    const cv::Mat truth = cv::imread(streetFolder() + "/global.png");
    ASSERT_EQ(truth.size(), corrected.size());
    ASSERT_EQ(truth.size(), overlay.size());
    EXPECT_LT(differenceInside(truth, corrected), 0.5 * differenceInside(truth, before));
    EXPECT_GT(cv::norm(before, overlay, cv::NORM_INF), 0);
}

TEST(ModuleSamples, correct_frame_without_image)
{
    EXPECT_EQ(2, runProgram(CORRECT_FRAME_PROGRAM, {}).exitCode);
    EXPECT_EQ(1, runProgram(CORRECT_FRAME_PROGRAM, {"/no/such/image.png"}).exitCode);
}

TEST(ModuleSamples, minimal_solvers)
{
    const TemporaryFolder folder;
    const std::string raw = streetFolder() + "/rolling.png";
    const Outcome outcome = runProgram(MINIMAL_SOLVERS_PROGRAM, {raw, folder / "corrected.png", "--focal=816"});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    const cv::Mat before = cv::imread(raw), corrected = cv::imread(folder / "corrected.png"),
                  truth = cv::imread(streetFolder() + "/global.png");
    ASSERT_EQ(truth.size(), corrected.size());
    EXPECT_LT(differenceInside(truth, corrected), 0.8 * differenceInside(truth, before)) << outcome.output;
    EXPECT_EQ(2, runProgram(MINIMAL_SOLVERS_PROGRAM, {}).exitCode);
    EXPECT_EQ(1, runProgram(MINIMAL_SOLVERS_PROGRAM, {"/no/such/image.png"}).exitCode);
}

}} // namespace
