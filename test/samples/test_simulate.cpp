// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "program.hpp"
#include "options.hpp"
#include "truth_file.hpp"

#include "opencv2/imgproc.hpp"

namespace opencv_test { namespace {

TEST(Simulate, writes_images_truth_and_camera)
{
    EXPECT_EQ((std::vector<std::string>{"camera.yml", "global.png", "rolling.png", "truth.json"}),
              namesIn(streetFolder()));
    const rsackermann_samples::Truth truth = rsackermann_samples::readTruth(streetFolder() + "/truth.json");
    EXPECT_NEAR(60 / 3.6, truth.scene.speed, 1e-12);
    EXPECT_NEAR(40 * CV_PI / 180, truth.scene.yawRate, 1e-12);
    EXPECT_EQ(cv::Size(640, 380), truth.camera.size);
    EXPECT_NEAR(0.4 / 30 / 380, truth.camera.lineDelay, 1e-15);
}

TEST(Simulate, refuses_what_it_does_not_know)
{
    const TemporaryFolder folder;
    const std::string output = "--output=" + (folder / "out");
    for (const char* option : {"--sped=3", "--speed=fast", "--size=640", "--size=0x3", "--left=-1", "--lens=1,2",
                               "--lens=1,2,x,4", "--clutter=2", "--stagger=-1", "--obstacles=101", "--samples=0",
                               "--rays=x", "--stains=2", "--scan=x", "--line_delay=1e-5,", "street.png"})
        EXPECT_EQ(2, simulate({output, option}).exitCode) << option;
    EXPECT_EQ(2, simulate({}).exitCode);
    EXPECT_EQ(2, simulate({output, "--image=" + streetFolder() + "/global.png", "--clutter=1"}).exitCode);
    EXPECT_EQ(2, simulate({output, "--image=" + streetFolder() + "/global.png", "--stagger=1"}).exitCode);
    EXPECT_EQ(2, simulate({output, "--image=" + streetFolder() + "/global.png", "--obstacles=1"}).exitCode);
    EXPECT_EQ(1, simulate({output, "--image=/no/such.png"}).exitCode);
    EXPECT_TRUE(namesIn(folder.path()).empty());
    EXPECT_EQ(0, simulate({"--help"}).exitCode);
}

TEST(Simulate, read_out_longer_than_the_time_between_frames)
{
    for (const char* readOut : {"0.05", "0.03"})
    {
        const TemporaryFolder folder;
        const Outcome outcome = simulate({"--output=" + folder.path(), "--frames=1", "--size=64x48", "--focal=60",
                                          std::string("--readout=") + readOut});
        EXPECT_EQ(0, outcome.exitCode);
        EXPECT_EQ(readOut == std::string("0.05"),
                  outcome.messages.find("the read-out of 0.05 s is longer than the 0.0333 s between frames") !=
                      std::string::npos)
            << outcome.messages;
    }
}

TEST(Simulate, true_depth)
{
    const TemporaryFolder folder;
    ASSERT_EQ(0, simulate({"--output=" + folder.path(), "--depth", "--size=64x38", "--focal=82", "--speed=0",
                           "--yaw_rate=0", "--height=1.5"})
                     .exitCode);
    const cv::Mat raw = cv::imread(folder / "rolling_depth.png", cv::IMREAD_UNCHANGED),
                  global = cv::imread(folder / "global_depth.png", cv::IMREAD_UNCHANGED);
    ASSERT_EQ(CV_16UC1, raw.type());
    EXPECT_EQ(0, cv::norm(raw, global, cv::NORM_INF));
    // The road at the lower border, straight ahead; walls at 2.5 and 3 m; and the sky
    EXPECT_NEAR(1.5 * 82 / (37 - 18.5) * 256, raw.at<ushort>(37, 32), 1);
    EXPECT_NEAR(2.5 * 82 / 31.5 * 256, raw.at<ushort>(20, 0), 1);
    EXPECT_NEAR(3 * 82 / 31.5 * 256, raw.at<ushort>(20, 63), 1);
    EXPECT_EQ(2,
              simulate({"--output=" + folder.path(), "--image=" + streetFolder() + "/global.png", "--depth"}).exitCode);
}

TEST(Simulate, does_not_replace_existing_files)
{
    const TemporaryFolder folder;
    writeContent(folder / "truth.json", "precious");
    const Arguments arguments = {"--output=" + folder.path(), "--size=64x38", "--focal=82"};
    EXPECT_EQ(1, simulate(arguments).exitCode);
    EXPECT_EQ("precious", contentOf(folder / "truth.json"));
    EXPECT_EQ(1u, namesIn(folder.path()).size());
}

TEST(Simulate, same_seed_same_picture)
{
    const TemporaryFolder folder;
    Arguments arguments = {"--output=" + (folder / "a"), "--size=128x76", "--focal=160", "--seed=8"};
    ASSERT_EQ(0, simulate(arguments).exitCode);
    arguments[0] = "--output=" + (folder / "b");
    ASSERT_EQ(0, simulate(arguments).exitCode);
    EXPECT_EQ(contentOf(folder / "a/rolling.png"), contentOf(folder / "b/rolling.png"));
    arguments[0] = "--output=" + (folder / "c");
    arguments[3] = "--seed=9";
    ASSERT_EQ(0, simulate(arguments).exitCode);
    EXPECT_NE(contentOf(folder / "a/rolling.png"), contentOf(folder / "c/rolling.png"));
}

TEST(Simulate, at_rest_both_shutters_see_the_same)
{
    const TemporaryFolder folder;
    ASSERT_EQ(0, simulate({"--output=" + folder.path(), "--speed=0", "--yaw_rate=0", "--noise=0", "--size=128x76",
                           "--focal=160"})
                     .exitCode);
    EXPECT_EQ(0, cv::norm(cv::imread(folder / "rolling.png"), cv::imread(folder / "global.png"), cv::NORM_INF));
}

TEST(Simulate, camera_that_looks_to_the_right_at_one_wall)
{
    const TemporaryFolder folder;
    ASSERT_EQ(0, simulate({"--output=" + folder.path(), "--heading=-90", "--left=0", "--right=3", "--speed=40",
                           "--yaw_rate=0"})
                     .exitCode);
    const rsackermann_samples::Truth truth = rsackermann_samples::readTruth(folder / "truth.json");
    EXPECT_EQ(0, truth.scene.left);
    EXPECT_EQ(3, truth.scene.right);
    const Outcome corrected = correct({folder / "rolling.png", "--camera=" + (folder / "camera.yml"), "--wall=3",
                                       "--report=" + (folder / "report.jsonl"), "--maps=" + (folder / "maps.yml")});
    ASSERT_EQ(0, corrected.exitCode) << corrected.messages;
    const nlohmann::json report = nlohmann::json::parse(contentOf(folder / "report.jsonl"));
    EXPECT_EQ("ok", report["status"]);
    EXPECT_TRUE(report["wall_ratio"].is_null());
    EXPECT_NEAR(40, report["speed_km_h"].get<double>(), 4);
    const Outcome evaluated = evaluate({"--truth=" + (folder / "truth.json"), "--report=" + (folder / "report.jsonl"),
                                        "--maps=" + (folder / "maps.yml")});
    EXPECT_EQ(0, evaluated.exitCode);
    // There is neither a vanishing point in the image nor a second wall.
    for (const char* row : {"vanishing point", "wall distances"})
        EXPECT_EQ(std::string::npos, evaluated.output.find(row)) << evaluated.output;
}

// Also what an int can't hold, and what is no number.
TEST(Simulate, truth_out_of_range_is_refused)
{
    const TemporaryFolder folder;
    const std::string file = folder / "truth.json";
    const nlohmann::json good = nlohmann::json::parse(contentOf(streetFolder() + "/truth.json"));
    for (const char* key : {"width",        "height",
                            "scan",         "seed",
                            "fx",           "fy",
                            "cx",           "cy",
                            "lens",         "line_delay_s",
                            "reference",    "height_m",
                            "roll_deg",     "pitch_deg",
                            "heading_deg",  "yaw_rate_deg_s",
                            "speed_km_h",   "left_wall_m",
                            "right_wall_m", "wall_direction_deg",
                            "stagger_m",    "obstacles_per_100_m",
                            "stains",       "time_s",
                            "travelled_m"})
        for (const char* value : {"-1e10", "1e10", "-1e300", "\"1\"", "null", "[1]", "NaN", "1e999"})
        {
            nlohmann::json json = good;
            json[key] = "VALUE";
            std::string content = json.dump(2);
            content.replace(content.find("\"VALUE\""), 7, value);
            writeContent(file, content);
            try
            {
                rsackermann_samples::readTruth(file);
                FAIL() << content;
            }
            catch (const rsackermann_samples::InputError& e)
            {
                const std::string message = e.what();
                EXPECT_EQ(0u, message.find(file + ": ")) << message;
                EXPECT_NE(std::string::npos, message.find(value == std::string("1e999") ? value : key)) << message;
                EXPECT_EQ(std::string::npos, message.find("json.exception")) << message;
            }
        }
    for (const char* key : {"fx", "fy", "line_delay_s", "height_m", "left_wall_m", "stagger_m"})
    {
        nlohmann::json json = good;
        json[key] = key[0] == 'f' ? 0 : -1;
        writeContent(file, json.dump());
        EXPECT_THROW(rsackermann_samples::readTruth(file), rsackermann_samples::InputError) << key;
    }
    writeContent(file, good.dump());
    EXPECT_NO_THROW(rsackermann_samples::readTruth(file));
}

TEST(Simulate, staggered_rays)
{
    const TemporaryFolder folder;
    ASSERT_EQ(0,
              simulate({"--output=" + folder.path(), "--rays=staggered", "--noise=0", "--size=128x76", "--focal=160"})
                  .exitCode);
    const rsackermann_samples::Truth truth = rsackermann_samples::readTruth(folder / "truth.json");
    street::StreetScene scene = truth.scene;
    scene.noise = 0;
    const street::StreetRenderer renderer(truth.camera, scene);
    const street::StreetRenderer::Rays rays = street::StreetRenderer::STAGGERED;
    const cv::Mat rolling = cv::imread(folder / "rolling.png"), global = cv::imread(folder / "global.png");
    // A grey level of rounding
    EXPECT_LE(cv::norm(rolling, renderer.rollingShutter(3, rays), cv::NORM_INF), 1);
    EXPECT_LE(cv::norm(global, renderer.globalShutter(3, rays), cv::NORM_INF), 1);
    EXPECT_GT(cv::norm(global, renderer.globalShutter(3), cv::NORM_INF), 20);
}

TEST(Simulate, truth_knows_staggered_houses_and_obstacles)
{
    const TemporaryFolder folder;
    const Outcome outcome =
        simulate({"--output=" + folder.path(), "--stagger=1.5", "--obstacles=40", "--seed=7", "--stains=0.4",
                  "--left=5", "--right=6", "--noise=0", "--size=128x76", "--focal=160"});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    const nlohmann::json json = nlohmann::json::parse(contentOf(folder / "truth.json"));
    EXPECT_EQ(1.5, json["stagger_m"]);
    EXPECT_EQ(40, json["obstacles_per_100_m"]);
    EXPECT_EQ(0.4, json["stains"]);
    EXPECT_EQ(7, json["seed"]);

    // The truth that is read makes the same image, and each of these values matters.
    rsackermann_samples::Truth truth = rsackermann_samples::readTruth(folder / "truth.json");
    truth.scene.noise = 0;
    const cv::Mat rolling = cv::imread(folder / "rolling.png");
    const auto isSame = [&](const street::StreetScene& scene) {
        // A grey level of rounding
        return cv::norm(rolling, street::StreetRenderer(truth.camera, scene).rollingShutter(), cv::NORM_INF) <= 1;
    };
    EXPECT_TRUE(isSame(truth.scene));
    street::StreetScene inLine = truth.scene, empty = truth.scene, clean = truth.scene, other = truth.scene;
    inLine.stagger = 0;
    empty.obstacles = 0;
    clean.stains = 0;
    other.seed++;
    EXPECT_FALSE(isSame(inLine));
    EXPECT_FALSE(isSame(empty));
    EXPECT_FALSE(isSame(clean));
    EXPECT_FALSE(isSame(other));
}

TEST(Simulate, distorts_a_given_image)
{
    const TemporaryFolder folder;
    const Arguments motion = {"--speed=60", "--yaw_rate=40", "--focal=816", "--height=1.2"};
    Arguments arguments = motion;
    arguments.push_back("--output=" + (folder / "again"));
    arguments.push_back("--image=" + streetFolder() + "/global.png");
    const Outcome outcome = simulate(arguments);
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    const cv::Mat global = cv::imread(streetFolder() + "/global.png"), rendered = streetImage(),
                  distorted = cv::imread(folder / "again/rolling.png");
    nlohmann::json truth = nlohmann::json::parse(contentOf(streetFolder() + "/truth.json"));
    truth["seed"] = 0; // of a rendered street; a given image has none
    EXPECT_EQ(truth, nlohmann::json::parse(contentOf(folder / "again/truth.json")));
    // Away from the border both ways of simulation show the same.
    const cv::Rect inner(20, 20, global.cols - 40, global.rows - 40);
    const double raw = cv::norm(rendered(inner), global(inner), cv::NORM_L1),
                 left = cv::norm(rendered(inner), distorted(inner), cv::NORM_L1);
    EXPECT_LT(left, 0.4 * raw);
}

}} // namespace
