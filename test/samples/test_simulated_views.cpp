// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// What rsackermann_simulate writes of each frame of a drive beside the image: pose, depth and the global-shutter view.

#include "program.hpp"
#include "options.hpp"
#include "truth_file.hpp"

namespace opencv_test { namespace {

using nlohmann::json;

// A camera that looks half to the right, shakes and reads its rows at nearly the same instant.
Outcome simulateDrive(const std::string& output, const Arguments& options, int frames = 12,
                      const Arguments& walls = {"--left=6", "--right=6"})
{
    return simulate(Arguments{"--output=" + output, cv::format("--frames=%d", frames), "--size=160x95", "--focal=150",
                              "--samples=2", "--speed=30", "--heading=-45", "--noise=0", "--rays=staggered",
                              "--shake=phone"} +
                    walls + options);
}

std::vector<json> truthOf(const std::string& folder)
{
    std::vector<json> lines;
    for (const std::string& line : linesOf(folder + "/truth.jsonl"))
        lines.push_back(json::parse(line));
    return lines;
}

cv::Matx44d viewOf(const json& truth)
{
    cv::Matx44d view;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            view(i, j) = truth["viewmat"][size_t(i)][size_t(j)];
    return view;
}

cv::Mat1d depthOf(const std::string& folder, const json& truth)
{
    cv::Mat1d metres;
    cv::imread(folder + "/depth/" + truth["file"].get<std::string>(), cv::IMREAD_UNCHANGED)
        .convertTo(metres, CV_64F, 1. / 256);
    return metres;
}

// Places that the depth of one frame shows are where the pose and the depth of another one have them.
TEST(SimulatedViews, poses_and_depths_of_frames_agree)
{
    const TemporaryFolder folder;
    ASSERT_EQ(0, simulateDrive(folder.path(), {"--readout=1e-7", "--depth"}).exitCode);
    EXPECT_EQ(12u, namesIn(folder / "depth").size());
    const std::vector<json> truth = truthOf(folder.path());
    const json &first = truth.front(), &last = truth.back();
    const cv::Mat1d before = depthOf(folder.path(), first), after = depthOf(folder.path(), last);
    const cv::Matx44d step = viewOf(last) * viewOf(first).inv();
    EXPECT_GT(cv::norm(step - cv::Matx44d::eye()), 1);
    const double focal = 150, cx = 79.5, cy = 47;
    int seen = 0, agreeing = 0;
    for (int y = 0; y < before.rows; y++)
        for (int x = 0; x < before.cols; x++)
        {
            const double z = before(y, x);
            const cv::Vec4d place = step * cv::Vec4d((x - cx) / focal * z, (y - cy) / focal * z, z, 1);
            const cv::Point there(cvRound(place[0] / place[2] * focal + cx), cvRound(place[1] / place[2] * focal + cy));
            if (z == 0 || place[2] <= 0 || !cv::Rect(cv::Point(), before.size()).contains(there))
                continue;
            seen++;
            agreeing += std::abs(after(there) - place[2]) < 0.03 * place[2];
        }
    const double z = before(94, 80);
    const cv::Vec4d road = viewOf(first).inv() * cv::Vec4d((80 - cx) / focal * z, (94 - cy) / focal * z, z, 1);
    EXPECT_NEAR(1.2, road[1], 0.01);
    EXPECT_GT(seen, 3000);
    EXPECT_GT(agreeing, 0.98 * seen);
}

// How much the road's colours in the last frame differ from those at the same places in the first one.
double changeOfRoad(const std::string& folder)
{
    const std::vector<json> truth = truthOf(folder);
    const json &first = truth.front(), &last = truth.back();
    const cv::Mat1d depth = depthOf(folder, first);
    const auto image = [&](const json& frame) {
        cv::Mat3b colours = cv::imread(folder + "/frames/" + frame["file"].get<std::string>());
        cv::GaussianBlur(colours, colours, cv::Size(), 1);
        return colours;
    };
    const cv::Mat3b before = image(first), after = image(last);
    const double focal = 150, cx = 79.5, cy = 47;
    double sum = 0;
    int count = 0;
    for (int y = 60; y < depth.rows; y++)
        for (int x = 0; x < depth.cols; x++)
        {
            const double z = depth(y, x);
            const cv::Vec4d ray((x - cx) / focal * z, (y - cy) / focal * z, z, 1),
                place = viewOf(last) * viewOf(first).inv() * ray;
            const cv::Point there(cvRound(place[0] / place[2] * focal + cx), cvRound(place[1] / place[2] * focal + cy));
            if (std::abs((viewOf(first).inv() * ray)[1] - 1.2) > 0.02 || place[2] <= 0 ||
                !cv::Rect(cv::Point(), depth.size()).contains(there))
                continue;
            sum += cv::norm(cv::Vec3d(before(y, x)) - cv::Vec3d(after(there)));
            count++;
        }
    EXPECT_GT(count, 200);
    return sum / count;
}

// The road stays where it is beside a car that weaves, whether or not there are walls.
TEST(SimulatedViews, road_without_walls)
{
    const TemporaryFolder folder;
    const Arguments drive = {"--readout=1e-7", "--depth"};
    ASSERT_EQ(0, simulateDrive(folder / "walls", drive, 30).exitCode);
    const double expected = changeOfRoad(folder / "walls");
    for (const Arguments& walls : {Arguments{"--left=0", "--right=6"}, Arguments{"--left=6", "--right=0"}})
    {
        ASSERT_EQ(0, simulateDrive(folder / walls[0], drive, 30, walls).exitCode);
        const double change = changeOfRoad(folder / walls[0]);
        EXPECT_LT(change, 1.2 * expected) << walls[0];
    }
}

// As the sky.
TEST(SimulatedViews, depth_that_16_bits_do_not_reach_is_unknown)
{
    const TemporaryFolder folder;
    ASSERT_EQ(0, simulate({"--output=" + folder.path(), "--left=0", "--right=0", "--depth"}).exitCode);
    for (const char* name : {"rolling_depth.png", "global_depth.png"})
    {
        const cv::Mat depth = cv::imread(folder / name, cv::IMREAD_UNCHANGED);
        double farthest;
        cv::minMaxLoc(depth, nullptr, &farthest);
        EXPECT_GT(farthest, 200 * 256) << name;
        EXPECT_LE(farthest, 255 * 256) << name;
    }
}

// The camera begins at the origin of the street and drives along it.
TEST(SimulatedViews, street_begins_with_the_drive)
{
    const TemporaryFolder folder;
    ASSERT_EQ(0, simulateDrive(folder.path(), {}).exitCode);
    const std::vector<json> truth = truthOf(folder.path());
    for (const json& frame : truth)
    {
        const cv::Matx44d camera = viewOf(frame).inv();
        EXPECT_NEAR(frame["left_wall_m"].get<double>() - 6, camera(0, 3), 1e-9);
        EXPECT_NEAR(0, camera(1, 3), 1e-9);
        EXPECT_NEAR(frame["travelled_m"].get<double>(), camera(2, 3), 1e-9);
    }
}

TEST(SimulatedViews, global_shutter)
{
    const TemporaryFolder folder;
    ASSERT_EQ(0, simulateDrive(folder / "slow", {"--readout=0.03", "--global"}).exitCode);
    ASSERT_EQ(0, simulateDrive(folder / "fast", {"--readout=1e-7", "--global"}).exitCode);
    EXPECT_EQ((std::vector<std::string>{"camera.yml", "frames", "global", "gyro.csv", "log.csv", "truth.jsonl"}),
              namesIn(folder / "slow"));
    for (const std::string& name : namesIn(folder / "slow/frames"))
    {
        const cv::Mat global = cv::imread(folder / ("slow/global/" + name)),
                      raw = cv::imread(folder / ("slow/frames/" + name)),
                      fast = cv::imread(folder / ("fast/frames/" + name));
        // Edges that pass a ray in no time
        EXPECT_LT(cv::norm(global, fast, cv::NORM_L1), 1e-3 * double(global.total() * 3));
        EXPECT_GT(cv::norm(global, raw, cv::NORM_L1), double(global.total() * 3));
    }
}

TEST(SimulatedViews, speed_swings)
{
    const TemporaryFolder folder;
    ASSERT_EQ(0, simulateDrive(folder.path(), {"--speed_swing=9"}, 61).exitCode);
    const std::vector<json> truth = truthOf(folder.path());
    EXPECT_NEAR(39, truth[0]["speed_km_h"].get<double>(), 1e-9);
    EXPECT_NEAR(30, truth[30]["speed_km_h"].get<double>(), 1e-9);
    EXPECT_NEAR(21, truth[60]["speed_km_h"].get<double>(), 1e-9);
    double way = 0;
    for (size_t i = 1; i < truth.size(); i++)
        way += cv::norm((viewOf(truth[i]).inv() - viewOf(truth[i - 1]).inv()).col(3));
    EXPECT_NEAR(2 * 30 / 3.6, way, 0.01);
}

TEST(SimulatedViews, files_that_are_there_stay)
{
    for (const char* kind : {"depth", "global"})
    {
        const TemporaryFolder folder;
        const auto expectRefused = [&](const std::string& name, const std::string& reason) {
            const std::string file = std::string(kind) + name;
            writeContent(folder / file, "precious");
            const Outcome outcome = simulateDrive(folder.path(), {std::string("--") + kind});
            EXPECT_EQ(1, outcome.exitCode);
            EXPECT_NE(std::string::npos, outcome.messages.find(file + reason)) << outcome.messages;
            EXPECT_EQ("precious", contentOf(folder / file));
        };
        cv::utils::fs::createDirectories(folder / kind);
        expectRefused("/000012.png", " is of a longer drive");
        expectRefused("/000003.png", " exists (--overwrite replaces it)");
        EXPECT_EQ(1u, namesIn(folder.path()).size());
    }
}

TEST(SimulatedViews, options_of_drives)
{
    const TemporaryFolder folder;
    for (const char* option : {"--global", "--speed_swing=3"})
        EXPECT_EQ(2, simulate({"--output=" + folder.path(), option}).exitCode) << option;
}

}} // namespace
