// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "program.hpp"

#include "opencv2/imgproc.hpp"

namespace opencv_test { namespace {

void writeFloats(const std::string& path, const cv::Mat1f& values)
{
    writeContent(path, std::string(reinterpret_cast<const char*>(values.data), values.total() * sizeof(float)));
}

// A street with cars and trees, and networks with input of its size, written by onnx_networks.py.
class DepthNetwork : public testing::Test
{
protected:
    static void SetUpTestCase()
    {
        folder_ = new TemporaryFolder;
        ASSERT_EQ(0, simulate({"--output=" + file("street"), "--depth", "--left=3.2", "--right=4", "--obstacles=15",
                               "--stagger=1.5"})
                         .exitCode);
        cv::imread(file("street/rolling_depth.png"), cv::IMREAD_UNCHANGED).convertTo(metres_, CV_32F, 1. / 256);
        // As networks say it: of unknown scale and shift, and the sky is far.
        cv::divide(40, metres_, relative_);
        relative_.setTo(0, metres_ == 0);
        relative_ += 1.5;
        cv::Mat1f mirrored;
        cv::flip(relative_, mirrored, 1);
        makeNetworks("relative", relative_);
        makeNetworks("mirrored", mirrored);
        makeNetworks("metric", metres_);
    }

    static void TearDownTestCase() { delete folder_; }

    static std::string file(const std::string& name) { return *folder_ / name; }

    // A folder with networks, of which the one called given has that output.
    static void makeNetworks(const std::string& name, const cv::Mat1f& depth)
    {
        cv::utils::fs::createDirectories(file(name));
        writeFloats(file("depth.bin"), depth);
        const Outcome outcome = runProgram("python3", {ONNX_NETWORKS, file(name), std::to_string(depth.cols),
                                                       std::to_string(depth.rows), file("depth.bin")});
        ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    }

    static Arguments camera()
    {
        return {file("street/rolling.png"), "--camera=" + file("street/camera.yml"), "--speed=60", "--yaw_rate=40"};
    }

    Outcome run(const std::string& network, const Arguments& added = {}, const std::string& size = "640x380") const
    {
        return runProgram(DEPTH_NETWORK_PROGRAM,
                          camera() +
                              Arguments{"--model=" + file(network + ".onnx"), "--input_size=" + size,
                                        "--output=" + output, "--depth_output=" + depthOutput, "--overwrite"} +
                              added);
    }

    // What the network has said of the street.
    cv::Mat1f said(const std::string& network, const Arguments& added = {}, const std::string& size = "640x380") const
    {
        const Outcome outcome = run(network, added, size);
        EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
        return cv::imread(depthOutput, cv::IMREAD_UNCHANGED);
    }

    // The street as rsackermann_correct corrects it.
    std::string corrected(const Arguments& added = {}) const
    {
        const Outcome outcome =
            correct(camera() + Arguments{"--output=" + (folder / "other.png"), "--overwrite"} + added);
        EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
        return contentOf(folder / "other.png");
    }

    // Of red, green and blue, what the network called sum says.
    static cv::Mat1f sum(const cv::Vec3d& weights, double bias)
    {
        cv::Mat1f result;
        cv::Mat3f image;
        cv::imread(file("street/rolling.png")).convertTo(image, CV_32F);
        cv::transform(image, result, cv::Matx14f(float(weights[2]), float(weights[1]), float(weights[0]), float(bias)));
        return result;
    }

    static TemporaryFolder* folder_;
    static cv::Mat1f metres_, relative_;
    const TemporaryFolder folder;
    const std::string output = folder / "output.png", depthOutput = folder / "depth.tiff";
};

TemporaryFolder* DepthNetwork::folder_ = nullptr;
cv::Mat1f DepthNetwork::metres_, DepthNetwork::relative_;

TEST_F(DepthNetwork, has_the_input_that_the_options_say)
{
    const double red = 0.25, green = 0.5, blue = 0.125, bias = 0.75, limit = 1e-4;
    const auto difference = [&](const Arguments& added, const cv::Vec3d& weights, double constant) {
        return cv::norm(said("relative/sum", added), sum(weights, constant), cv::NORM_INF);
    };
    EXPECT_LT(difference({}, cv::Vec3d(red, green, blue) / 255, bias), limit);
    EXPECT_LT(difference({"--network=midas"}, cv::Vec3d(red, green, blue) / 255, bias), limit);
    EXPECT_LT(difference({"--network=dpt"}, cv::Vec3d(red, green, blue) / 127.5, bias - red - green - blue), limit);
    const cv::Vec3d anything(red / 58.395, green / 57.12, blue / 57.375);
    EXPECT_LT(
        difference({"--network=depth_anything"}, anything, bias - anything.dot(cv::Vec3d(123.675, 116.28, 103.53))),
        limit);
    EXPECT_LT(difference({"--bgr"}, cv::Vec3d(blue, green, red) / 255, bias), limit);
    EXPECT_LT(difference({"--mean=10,20,30", "--scale=1,2,3"}, cv::Vec3d(red, 2 * green, 3 * blue),
                         bias - 10 * red - 40 * green - 90 * blue),
              limit * 255);
    EXPECT_LT(difference({"--mean=10", "--scale=2"}, 2 * cv::Vec3d(red, green, blue), bias - 20 * (red + green + blue)),
              limit * 255);
}

TEST_F(DepthNetwork, output_of_another_size_is_scaled)
{
    const cv::Mat1f small = said("relative/sum", {}, "320x190");
    cv::Mat1f large = sum(cv::Vec3d(0.25, 0.5, 0.125) / 255, 0.75), difference;
    ASSERT_EQ(large.size(), small.size());
    cv::GaussianBlur(large - small, difference, cv::Size(), 4); // without what the small image can't show
    EXPECT_LT(cv::norm(difference, cv::NORM_INF), 0.01);
}

TEST_F(DepthNetwork, corrects_as_a_file_with_the_same_depth)
{
    for (const char* kind : {"relative", "metric"})
    {
        SCOPED_TRACE(kind);
        const std::string depthKind = "--depth_kind=" + std::string(kind);
        const Outcome outcome = run(kind + std::string("/given"), {depthKind});
        EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
        EXPECT_NE(std::string::npos, outcome.output.find("depth used")) << outcome.output;
        const cv::Mat1f depth = cv::imread(depthOutput, cv::IMREAD_UNCHANGED);
        EXPECT_EQ(0, cv::norm(depth, kind[0] == 'm' ? metres_ : relative_, cv::NORM_INF));
        EXPECT_EQ(corrected({"--depth=" + depthOutput, depthKind}), contentOf(output));
        EXPECT_NE(corrected(), contentOf(output));
    }
}

TEST_F(DepthNetwork, options_do_what_they_do_without_a_network)
{
    std::set<std::string> results;
    for (const char* option : {"--depth_kind=relative", "--wall=2", "--speed_sigma=9", "--yaw_rate_sigma=7",
                               "--height=1.9", "--roll=1", "--reference=first"})
    {
        SCOPED_TRACE(option);
        EXPECT_EQ(0, run("relative/given", {option}).exitCode);
        EXPECT_TRUE(results.insert(contentOf(output)).second); // has an effect
        Arguments others = {"--depth=" + depthOutput, "--depth_kind=relative"};
        if (others[1] != option)
            others.push_back(option);
        EXPECT_EQ(corrected(others), contentOf(output));
    }
}

TEST_F(DepthNetwork, that_contradicts_the_image_is_not_used)
{
    const std::string without = corrected();
    for (const char* network : {"mirrored/given", "relative/constant", "relative/sum", "metric/given"})
    {
        const Outcome outcome = run(network);
        EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
        EXPECT_NE(std::string::npos, outcome.output.find("ok")) << outcome.output;
        EXPECT_NE(std::string::npos, outcome.output.find("depth not used: it contradicts")) << outcome.output;
        EXPECT_EQ(without, contentOf(output)) << network;
    }
}

TEST_F(DepthNetwork, metres_need_the_speed_in_metres)
{
    const Outcome outcome =
        runProgram(DEPTH_NETWORK_PROGRAM, {file("street/rolling.png"), "--camera=" + file("street/camera.yml"),
                                           "--yaw_rate=40", "--model=" + file("metric/given.onnx"),
                                           "--input_size=640x380", "--depth_kind=metric", "--output=" + output});
    EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
    EXPECT_NE(std::string::npos, outcome.output.find("the speed in metres is unknown")) << outcome.output;
}

TEST_F(DepthNetwork, wrong_networks_are_named)
{
    writeContent(file("relative/text.onnx"), "not a network");
    writeContent(file("relative/empty.onnx"), "");
    for (const char* network : {"cut", "empty", "missing", "one_number", "text", "two_channels", "two_inputs",
                                "two_outputs", "unknown_operator"})
    {
        const Outcome outcome = run("relative/" + std::string(network));
        EXPECT_EQ(1, outcome.exitCode) << network;
        EXPECT_NE(std::string::npos, outcome.messages.find(file("relative/" + std::string(network) + ".onnx: ")))
            << outcome.messages;
        EXPECT_TRUE(namesIn(folder.path()).empty()) << network;
    }
}

TEST_F(DepthNetwork, bad_images_are_named_and_others_processed)
{
    const TemporaryFolder in;
    const std::string image = contentOf(file("street/rolling.png"));
    writeContent(in / "a_cut.png", image.substr(0, 1000));
    writeContent(in / "b_good.png", image);
    writeContent(in / "c_text.png", "no image");
    const Outcome outcome =
        runProgram(DEPTH_NETWORK_PROGRAM,
                   {in.path(), in / "d_missing.png", "--model=" + file("relative/given.onnx"), "--input_size=640x380",
                    "--output=" + folder.path(), "--depth_output=" + folder.path()});
    EXPECT_EQ(1, outcome.exitCode);
    for (const char* name : {"a_cut.png", "c_text.png", "d_missing.png"})
        EXPECT_NE(std::string::npos, outcome.messages.find(in / name + ": ")) << outcome.messages;
    EXPECT_EQ(0u, outcome.output.find(in / "b_good.png: ok")) << outcome.output;
    EXPECT_EQ((std::vector<std::string>{"b_good.png", "b_good.tiff"}), namesIn(folder.path()));
}

TEST_F(DepthNetwork, replaces_nothing)
{
    const std::string image = file("street/rolling.png"), camera = file("street/camera.yml"),
                      network = file("relative/given.onnx");
    const auto runTo = [&](const std::string& corrected, const std::string& depth, bool overwrite) {
        return runProgram(DEPTH_NETWORK_PROGRAM,
                          {image, "--camera=" + camera, "--model=" + network, "--output=" + corrected,
                           "--depth_output=" + depth, overwrite ? "--overwrite" : "--overwrite=false"});
    };
    writeContent(output, "existing");
    const Outcome outcome = runTo(output, depthOutput, false);
    EXPECT_EQ(1, outcome.exitCode);
    EXPECT_NE(std::string::npos, outcome.messages.find(output + " exists")) << outcome.messages;
    for (const std::string& input : {image, camera, network})
    {
        const std::string content = contentOf(input);
        for (const Outcome& refused : {runTo(input, depthOutput, true), runTo(output, input, true)})
        {
            EXPECT_EQ(2, refused.exitCode) << refused.messages;
            EXPECT_NE(std::string::npos, refused.messages.find("would replace the input")) << refused.messages;
        }
        EXPECT_EQ(content, contentOf(input));
    }
    EXPECT_EQ((std::vector<std::string>{"output.png"}), namesIn(folder.path()));
    EXPECT_EQ("existing", contentOf(output));
}

TEST_F(DepthNetwork, command_lines_that_are_not_understood)
{
    for (const char* wrong : {"--network=other", "--input_size=640", "--mean=1,2", "--scale=x",
                              "--depth_kind=disparity", "--speed_sigma=1", "--wall=-1", "--unknown"})
    {
        const Outcome outcome = runProgram(DEPTH_NETWORK_PROGRAM, {file("street/rolling.png"), "--output=" + output,
                                                                   "--model=" + file("relative/given.onnx"), wrong});
        EXPECT_EQ(2, outcome.exitCode) << wrong << " " << outcome.messages;
    }
    EXPECT_EQ(2, runProgram(DEPTH_NETWORK_PROGRAM, {"a.png", "--output=" + output}).exitCode);
    EXPECT_EQ(2, runProgram(DEPTH_NETWORK_PROGRAM, {"a.png", "--model=a.onnx"}).exitCode);
    EXPECT_EQ(2, runProgram(DEPTH_NETWORK_PROGRAM, {"--model=a.onnx", "--output=" + output}).exitCode);
    EXPECT_EQ(0, runProgram(DEPTH_NETWORK_PROGRAM, {"--help"}).exitCode);
}

}} // namespace opencv_test::
