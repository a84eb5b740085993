// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "program.hpp"
#include "map_distance.hpp"
#include "truth_file.hpp"

#include "test_lens_models.hpp"
#include "opencv2/rsackermann.hpp"

namespace opencv_test { namespace {

typedef nlohmann::ordered_json Json;

Arguments streetArguments()
{
    return {streetFolder() + "/rolling.png", "--camera=" + streetFolder() + "/camera.yml", "--wall=2.5"};
}

// The only line of a report.
Json reportOf(const std::string& path)
{
    const std::vector<std::string> lines = linesOf(path);
    EXPECT_EQ(1u, lines.size());
    return lines.empty() ? Json() : Json::parse(lines[0]);
}

bool isSame(const cv::Mat& a, const cv::Mat& b)
{
    return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

TEST(Correct, street_with_known_motion)
{
    const TemporaryFolder folder;
    const Outcome outcome = correct(
        streetArguments() + Arguments{"--gravity_sigma=0", "--output=" + (folder / "out.png"),
                                      "--overlay=" + (folder / "overlay.png"), "--report=" + (folder / "report.jsonl"),
                                      "--maps=" + (folder / "maps.yml")});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    EXPECT_EQ((std::vector<std::string>{"maps.yml", "out.png", "overlay.png", "report.jsonl"}), namesIn(folder.path()));

    const Json report = reportOf(folder / "report.jsonl");
    EXPECT_EQ("ok", report["status"]);
    EXPECT_EQ("4la", report["model"]);
    EXPECT_NEAR(40, report["yaw_rate_deg_s"].get<double>(), 8);
    EXPECT_NEAR(60, report["speed_km_h"].get<double>(), 20);
    EXPECT_GT(report["yaw_rate_sigma"].get<double>(), 0);
    EXPECT_GT(report["speed_sigma"].get<double>(), 0);

    // The maps are those that made the picture, and they undo most of the displacement.
    cv::Mat map1, map2, again;
    cv::FileStorage fs(folder / "maps.yml", cv::FileStorage::READ);
    fs["map1"] >> map1;
    fs["map2"] >> map2;
    ASSERT_EQ(CV_32FC1, map1.type());
    ASSERT_EQ(CV_32FC1, map2.type());
    cv::remap(streetImage(), again, map1, map2, cv::INTER_LINEAR);
    EXPECT_TRUE(isSame(again, cv::imread(folder / "out.png")));

    const rsackermann_samples::Truth truth = rsackermann_samples::readTruth(streetFolder() + "/truth.json");
    cv::Mat exact[2], identity[2], mask;
    street::StreetRenderer(truth.camera, truth.scene).rectifyMap(exact[0], exact[1], mask);
    rsackermann_samples::identityMaps(truth.camera.size, identity[0], identity[1]);
    const double before = rsackermann_samples::meanDistance(identity[0], identity[1], exact[0], exact[1], mask);
    const double after = rsackermann_samples::meanDistance(map1, map2, exact[0], exact[1], mask);
    EXPECT_GT(before, 2);
    EXPECT_LT(after, 0.45);
    EXPECT_NEAR(before, report["mean_shift_px"].get<double>(), 0.45);

    const cv::Mat overlay = cv::imread(folder / "overlay.png");
    EXPECT_EQ(truth.camera.size, overlay.size());
    EXPECT_FALSE(isSame(overlay, streetImage()));
}

TEST(Correct, report_keys)
{
    const char* const keys[] = {"input",
                                "width",
                                "height",
                                "roll_deg",
                                "pitch_deg",
                                "camera",
                                "status",
                                "model",
                                "alpha",
                                "beta",
                                "delta",
                                "wall_offset",
                                "wall_ratio",
                                "road_slope",
                                "direction",
                                "pitch_rate",
                                "roll_rate",
                                "roll_correction_deg",
                                "pitch_correction_deg",
                                "heading_correction_deg",
                                "wall_distance_m",
                                "scale",
                                "covariance",
                                "roll_yaw_ambiguous",
                                "yaw_rate_deg_s",
                                "speed_km_h",
                                "yaw_rate_sigma",
                                "speed_sigma",
                                "pitch_rate_deg_s",
                                "pitch_rate_sigma",
                                "roll_rate_deg_s",
                                "roll_rate_sigma",
                                "given_yaw_rate_deg_s",
                                "given_yaw_rate_sigma",
                                "given_speed_km_h",
                                "given_speed_sigma",
                                "contradicts_prior",
                                "seen_yaw_rate_deg_s",
                                "seen_yaw_rate_sigma",
                                "seen_speed_km_h",
                                "seen_speed_sigma",
                                "readout_ratio",
                                "readout_ratio_sigma",
                                "seen_heading_deg",
                                "seen_heading_sigma",
                                "segments",
                                "candidates",
                                "inliers",
                                "rms_px",
                                "expected_px_raw",
                                "expected_px_left",
                                "probability_worse",
                                "depth_used",
                                "mean_shift_px",
                                "ms_detect",
                                "ms_estimate",
                                "ms_map",
                                "ms_remap"};
    const TemporaryFolder folder;
    ASSERT_EQ(
        0, correct({streetFolder() + "/rolling.png", "--focal=816", "--report=" + (folder / "report.jsonl")}).exitCode);
    const Json report = reportOf(folder / "report.jsonl");
    size_t i = 0;
    ASSERT_EQ(sizeof keys / sizeof *keys, report.size());
    for (Json::const_iterator it = report.begin(); it != report.end(); ++it)
        EXPECT_EQ(keys[i++], it.key());
    EXPECT_EQ(streetFolder() + "/rolling.png", report["input"]);
    // Neither the line delay nor the wall's distance is known.
    EXPECT_TRUE(report["yaw_rate_deg_s"].is_null());
    EXPECT_TRUE(report["speed_km_h"].is_null());
    EXPECT_TRUE(report["alpha"].is_number());
    for (const char* key : {"segments", "candidates", "inliers"})
        EXPECT_TRUE(report[key].is_number_integer()) << key;
}

TEST(Correct, report_on_standard_output)
{
    const Outcome outcome = correct(streetArguments() + Arguments{"--report=-"});
    EXPECT_EQ(0, outcome.exitCode);
    EXPECT_EQ("ok", Json::parse(outcome.output)["status"]);
}

// A report without what differs from run to run.
Json resultOf(const std::string& line)
{
    Json report = Json::parse(line);
    for (const char* key : {"ms_detect", "ms_estimate", "ms_map", "ms_remap"})
        report.erase(key);
    return report;
}

Json resultOf(const Outcome& outcome)
{
    EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
    return resultOf(outcome.output);
}

// To the last bit: the report, the maps and the image of processes of their own.
TEST(Correct, same_result_whatever_the_number_of_threads)
{
    std::vector<std::string> first;
    for (const char* threads : {"1", "1", "2", "8"})
    {
        const TemporaryFolder folder;
        const Json report = resultOf(correct(
            streetArguments() + Arguments{"--report=-", "--seed=5", std::string("--threads=") + threads,
                                          "--maps=" + (folder / "maps.yml"), "--output=" + (folder / "out.png")}));
        const std::vector<std::string> results = {report.dump(), contentOf(folder / "maps.yml"),
                                                  contentOf(folder / "out.png")};
        if (first.empty())
            first = results;
        for (size_t i = 0; i < results.size(); i++)
            EXPECT_TRUE(first[i] == results[i]) << threads << " threads, result " << i;
    }
}

// Images that are corrected at the same time, of several sizes and with a log, one of them damaged: the same lines in
// the same order, and the same images.
TEST(Correct, same_results_of_a_folder_whatever_the_number_of_threads)
{
    const TemporaryFolder folder;
    const int images = 8;
    std::string log = "frame,speed_kmh,speed_sigma_kmh\n";
    cv::utils::fs::createDirectory(folder / "in");
    for (int i = 0; i < images; i++)
    {
        const double scale = i % 3 == 1 ? 0.5 : 1;
        cv::Mat image;
        cv::resize(streetImage(), image, cv::Size(), scale, scale, cv::INTER_AREA);
        cv::imwrite(folder / cv::format("in/%d.png", i), image);
        log += cv::format("%d,%d,5\n", i, 50 + 5 * i);
    }
    writeContent(folder / "in/4.png", "no image");
    writeContent(folder / "log.csv", log);

    std::vector<std::string> first;
    for (const char* threads : {"1", "2", "8"})
    {
        const std::string out = folder / ("out" + std::string(threads)), report = out + ".jsonl";
        const Outcome outcome = correct({folder / "in", "--readout=0.02", "--log=" + (folder / "log.csv"),
                                         std::string("--threads=") + threads, "--report=" + report, "--output=" + out});
        EXPECT_EQ(1, outcome.exitCode) << outcome.messages;
        std::vector<std::string> results;
        for (const std::string& line : linesOf(report))
            results.push_back(resultOf(line).dump());
        ASSERT_EQ(size_t(images), results.size());
        for (int i = 0; i < images; i++)
            if (i != 4)
                results.push_back(contentOf(out + cv::format("/%d.png", i)));
        if (first.empty())
            first = results;
        for (size_t i = 0; i < results.size(); i++)
            EXPECT_TRUE(first[i] == results[i])
                << threads << " threads, result " << i << ": " << results[i].substr(0, 200);
    }
}

// The lines are given, since the detectors of OpenCV depend on the processor, too. Sums in single precision differ in
// their last digits with and without fused multiply-adds: numbers do so far below their sigmas, maps do by their own
// rounding.
TEST(Correct, nearly_same_result_whatever_the_vectors)
{
    const TemporaryFolder folder;
    cv::Mat segments;
    cv::rsackermann::detectSegments(streetImage(), segments);
    std::ostringstream lines;
    for (int i = 0; i < segments.rows; i++)
        lines << segments.at<float>(i, 0) << " " << segments.at<float>(i, 1) << " " << segments.at<float>(i, 2) << " "
              << segments.at<float>(i, 3) << "\n";
    writeContent(folder / "lines.txt", lines.str());

    Json widest;
    cv::Mat widestMaps[2];
    for (const char* disabled : {"", "AVX512-SKX", "AVX512-SKX,AVX2"})
    {
        const Json report = resultOf(runProgram(
            "env", Arguments{std::string("OPENCV_CPU_DISABLE=") + disabled, CORRECT_PROGRAM} + streetArguments() +
                       Arguments{"--report=-", "--lines=" + (folder / "lines.txt"), "--overwrite",
                                 "--maps=" + (folder / "maps.yml")}));
        cv::Mat maps[2];
        const cv::FileStorage file(folder / "maps.yml", cv::FileStorage::READ);
        file["map1"] >> maps[0];
        file["map2"] >> maps[1];
        if (widest.empty())
        {
            widest = report.flatten();
            std::copy(maps, maps + 2, widestMaps);
        }
        EXPECT_EQ("ok", report["status"]);
        const Json values = report.flatten();
        for (const auto& expected : widest.items())
            if (expected.value().is_number_float())
                // Of an angle next to 0 a millionth of a degree.
                EXPECT_NEAR(expected.value().get<double>(), values[expected.key()].get<double>(),
                            1e-4 * (1e-2 + std::abs(expected.value().get<double>())))
                    << expected.key() << " without " << disabled;
            else
                EXPECT_EQ(expected.value(), values[expected.key()]) << expected.key() << " without " << disabled;
        for (int i = 0; i < 2; i++)
            EXPECT_LT(cv::norm(widestMaps[i], maps[i], cv::NORM_INF), 2e-4) << "map without " << disabled;
    }
}

TEST(Correct, speed_and_yaw_rate_known_from_elsewhere)
{
    const Arguments street = streetArguments() + Arguments{"--report=-"};
    const Json speed = resultOf(correct(street + Arguments{"--speed=60", "--speed_sigma=0.1"}));
    EXPECT_NEAR(60, speed["speed_km_h"].get<double>(), 0.3);
    EXPECT_LT(speed["speed_sigma"].get<double>(), 0.103); // as the posterior is integrated along its axes
    EXPECT_GT(speed["speed_sigma"].get<double>(), 0.05);
    EXPECT_NEAR(60, speed["given_speed_km_h"].get<double>(), 1e-9);
    EXPECT_NEAR(0.1, speed["given_speed_sigma"].get<double>(), 1e-9);
    EXPECT_TRUE(speed["given_yaw_rate_deg_s"].is_null());
    const Json yawRate = resultOf(correct(street + Arguments{"--yaw_rate=40", "--yaw_rate_sigma=0.1"}));
    EXPECT_NEAR(40, yawRate["yaw_rate_deg_s"].get<double>(), 0.3);
    EXPECT_LE(yawRate["yaw_rate_sigma"].get<double>(), 0.1);
    EXPECT_NEAR(40, yawRate["given_yaw_rate_deg_s"].get<double>(), 1e-9);
    EXPECT_NEAR(0.1, yawRate["given_yaw_rate_sigma"].get<double>(), 1e-9);
    EXPECT_TRUE(yawRate["given_speed_km_h"].is_null());

    EXPECT_EQ(
        resultOf(correct(street + Arguments{"--speed=58", "--speed_sigma=2", "--yaw_rate=41", "--yaw_rate_sigma=1"})),
        resultOf(correct(street + Arguments{"--speed=58", "--yaw_rate=41"})));
}

// Beside one wall, and with a roll that is off, verticals say so little that there may be no street: what is given
// counts then, as far as the model has it, and is no more certain.
TEST(Correct, given_values_where_there_may_be_no_street)
{
    const TemporaryFolder folder;
    const Outcome simulated =
        simulate({"--size=640x480", "--focal=600", "--readout=0.03", "--speed=37", "--yaw_rate=0", "--left=6.8",
                  "--right=0", "--pitch=1", "--height=1.3", "--seed=25", "--output=" + folder.path(), "--overwrite"});
    ASSERT_EQ(0, simulated.exitCode) << simulated.messages;
    const auto result = [&](const char* model) {
        const Outcome outcome =
            correct({folder / "rolling.png", "--camera=" + (folder / "camera.yml"), "--roll=-0.4", "--yaw_rate=-0.8",
                     "--speed=37", std::string("--model=") + model, "--report=-"});
        return resultOf(outcome);
    };
    const Json both = result("auto");
    EXPECT_GT(both["yaw_rate_sigma"].get<double>(), 0.8);
    EXPECT_GT(both["wall_distance_m"].get<double>(), 3.4);
    EXPECT_LT(both["wall_distance_m"].get<double>(), 14);
    EXPECT_GT(both["expected_px_raw"].get<double>(), 1);
    const Json turning = result("1la"), straight = result("3la");
    EXPECT_EQ("1la", turning["model"].get<std::string>());
    EXPECT_GT(turning["yaw_rate_sigma"].get<double>(), 0.8);
    EXPECT_EQ("3la", straight["model"].get<std::string>());
    EXPECT_EQ(0, straight["yaw_rate_deg_s"].get<double>());
}

// A standing camera that looks down moves nothing, unless it is given as level.
TEST(Correct, mount_that_is_not_given)
{
    const TemporaryFolder folder;
    ASSERT_EQ(0, simulate({"--output=" + (folder / "street"), "--size=640x360", "--readout=0.02", "--focal=576",
                           "--seed=1", "--speed=0", "--yaw_rate=0", "--left=4", "--right=6", "--pitch=4"})
                     .exitCode);
    const Arguments image = {folder / "street/rolling.png", "--focal=576", "--report=-"};
    EXPECT_EQ(0, resultOf(correct(image))["mean_shift_px"].get<double>());
    EXPECT_EQ(0, resultOf(correct(image + Arguments{"--roll=0"}))["mean_shift_px"].get<double>());
    EXPECT_LT(2, resultOf(correct(image + Arguments{"--roll=0", "--pitch=0"}))["mean_shift_px"].get<double>());
    EXPECT_EQ(0, resultOf(correct(image + Arguments{"--roll=0", "--pitch=4"}))["mean_shift_px"].get<double>());
}

TEST(Correct, scale_from_the_road)
{
    const Arguments image = {streetFolder() + "/rolling.png", "--camera=" + streetFolder() + "/camera.yml",
                             "--report=-"};
    EXPECT_TRUE(resultOf(correct(image + Arguments{"--height=1.2"}))["speed_km_h"].is_null());
    // The walls of the street are 2.5 m away, the camera is 1.2 m high.
    const Arguments upright = image + Arguments{"--height=1.2", "--gravity_sigma=0"};
    const Json withWall = resultOf(correct(upright + Arguments{"--wall=2.5"}));
    const Json fromRoad = resultOf(correct(upright + Arguments{"--scale_from_road"}));
    const double speed = withWall["speed_km_h"].get<double>();
    EXPECT_NEAR(speed, fromRoad["speed_km_h"].get<double>(), 0.1 * speed);

    const Outcome noHeight =
        correct({streetFolder() + "/rolling.png", "--focal=816", "--report=-", "--scale_from_road"});
    EXPECT_EQ(0, noHeight.exitCode);
    EXPECT_NE(std::string::npos, noHeight.messages.find("--scale_from_road has no effect without --height"))
        << noHeight.messages;
    EXPECT_EQ(2, correct(image + Arguments{"--wall=2.5", "--scale_from_road"}).exitCode);
}

TEST(Correct, what_is_known_but_of_no_use)
{
    const Arguments image = {streetFolder() + "/rolling.png", "--focal=816", "--report=-"};
    const Json plain = resultOf(correct(image + Arguments{"--wall=2.5"}));
    const Outcome outcome = correct(image + Arguments{"--wall=2.5", "--speed=10", "--yaw_rate=-10"});
    EXPECT_EQ(plain["alpha"], resultOf(outcome)["alpha"]);
    EXPECT_NE(std::string::npos, outcome.messages.find("--speed has no effect without the line delay"))
        << outcome.messages;
    EXPECT_NE(std::string::npos, outcome.messages.find("--yaw_rate has no effect without the line delay"))
        << outcome.messages;

    const Outcome carried = correct(image + Arguments{"--carry"});
    EXPECT_NE(std::string::npos, carried.messages.find("--carry has no effect without the line delay"))
        << carried.messages;

    EXPECT_EQ("", correct(image + Arguments{"--readout=0.0133", "--speed=10", "--carry"}).messages);
    EXPECT_EQ("", correct(streetArguments() + Arguments{"--report=-", "--speed=60", "--yaw_rate=40"}).messages);
}

TEST(Correct, gravity_that_is_not_exact)
{
    const Arguments tilted = streetArguments() + Arguments{"--report=-", "--roll=1"};
    const Json trusted = resultOf(correct(tilted + Arguments{"--gravity_sigma=0"})),
               corrected = resultOf(correct(tilted + Arguments{"--gravity_sigma=1"}));
    // The street was seen by a camera without roll.
    EXPECT_GT(std::abs(trusted["yaw_rate_deg_s"].get<double>() - 40), 20);
    EXPECT_NEAR(40, corrected["yaw_rate_deg_s"].get<double>(), 3 * corrected["yaw_rate_sigma"].get<double>());
    EXPECT_GT(corrected["yaw_rate_sigma"].get<double>(), trusted["yaw_rate_sigma"].get<double>());
}

TEST(Correct, segments_from_a_file)
{
    const TemporaryFolder folder;
    writeContent(folder / "lines.txt", "# x1 y1 x2 y2\n10,20,11,90\n\n 300 100 302 180 # a comment\n");
    const Json report =
        Json::parse(correct(streetArguments() + Arguments{"--report=-", "--lines=" + (folder / "lines.txt")}).output);
    EXPECT_EQ(2, report["segments"]);
    EXPECT_EQ("too_few_segments", report["status"]);
}

TEST(Correct, columnwise_shutter_is_not_observable)
{
    const TemporaryFolder folder;
    const Outcome outcome = correct(
        {streetFolder() + "/rolling.png", "--scan=left_to_right", "--report=-", "--output=" + (folder / "out.png")});
    EXPECT_EQ(0, outcome.exitCode);
    const Json report = Json::parse(outcome.output);
    EXPECT_EQ("not_observable", report["status"]);
    EXPECT_EQ("none", report["model"]);
    EXPECT_TRUE(report["alpha"].is_null());
    EXPECT_EQ(0, report["mean_shift_px"]);
    EXPECT_TRUE(isSame(streetImage(), cv::imread(folder / "out.png")));
}

TEST(Correct, model_none_leaves_the_image_alone)
{
    const TemporaryFolder folder;
    ASSERT_EQ(0, correct(streetArguments() + Arguments{"--model=none", "--output=" + (folder / "out.png")}).exitCode);
    EXPECT_EQ(contentOf(streetFolder() + "/rolling.png"), contentOf(folder / "out.png"));
}

// Images in which there is nothing to be found: the output is the input.
class CorrectDoesNoHarm : public testing::TestWithParam<const char*>
{
public:
    static cv::Mat make(const std::string& name)
    {
        cv::RNG rng(1);
        cv::Mat image;
        if (name == "black")
            image = cv::Mat::zeros(240, 320, CV_8UC3);
        else if (name == "one_pixel")
            image = cv::Mat(1, 1, CV_8UC3, cv::Scalar(10, 200, 30));
        else if (name == "one_row")
            image = cv::Mat(1, 300, CV_8UC1, cv::Scalar(50));
        else if (name == "one_column")
            image = cv::Mat(300, 1, CV_8UC1, cv::Scalar(50));
        else if (name == "horizontal_lines")
        {
            image = cv::Mat::zeros(240, 320, CV_8UC1);
            for (int y = 10; y < 240; y += 20)
                image.rowRange(y, y + 10).setTo(200);
        }
        else
        {
            image.create(240, 320, name == "noise_16_bit" ? CV_16UC1 : CV_8UC3);
            rng.fill(image, cv::RNG::UNIFORM, 0, name == "noise_16_bit" ? 65536 : 256);
        }
        return image;
    }
};

TEST_P(CorrectDoesNoHarm, output_is_input)
{
    const TemporaryFolder folder;
    const cv::Mat image = make(GetParam());
    cv::imwrite(folder / "in.png", image);
    const Outcome outcome = correct({folder / "in.png", "--output=" + (folder / "out.png"), "--report=-"});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    EXPECT_NE("ok", Json::parse(outcome.output)["status"]);
    EXPECT_TRUE(isSame(image, cv::imread(folder / "out.png", cv::IMREAD_UNCHANGED)));
}

INSTANTIATE_TEST_CASE_P(Correct, CorrectDoesNoHarm,
                        testing::Values("black", "one_pixel", "one_row", "one_column", "horizontal_lines", "noise",
                                        "noise_16_bit"));

TEST(Correct, jpeg_without_motion_is_not_coded_again)
{
    const TemporaryFolder folder;
    cv::imwrite(folder / "in.jpg", CorrectDoesNoHarm::make("noise"));
    ASSERT_EQ(0, correct({folder / "in.jpg", "--output=" + (folder / "out.jpg")}).exitCode);
    EXPECT_EQ(contentOf(folder / "in.jpg"), contentOf(folder / "out.jpg"));
}

TEST(Correct, without_motion_the_lens_is_corrected)
{
    const TemporaryFolder folder;
    const cv::Mat image = CorrectDoesNoHarm::make("noise");
    cv::imwrite(folder / "in.png", image);
    const cv::Matx33d K(300, 0, 160, 0, 310, 118, 0, 0, 1);
    const cv::Mat lens(cv::Matx<double, 1, 5>(-0.28, 0.07, 1e-3, -5e-4, 0.01));
    cv::FileStorage fs(folder / "camera.yml", cv::FileStorage::WRITE);
    fs << "image_width" << 320 << "image_height" << 240 << "camera_matrix" << cv::Mat(K) << "distortion_coefficients"
       << lens;
    fs.release();
    const Outcome outcome =
        correct({folder / "in.png", "--camera=" + (folder / "camera.yml"), "--output=" + (folder / "out.png"),
                 "--report=-", "--maps=" + (folder / "maps.yml")});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    ASSERT_NE("ok", Json::parse(outcome.output)["status"]);
    EXPECT_EQ(0, Json::parse(outcome.output)["mean_shift_px"]);
    cv::Mat expected1, expected2, map1, map2;
    cv::initUndistortRectifyMap(K, lens, cv::noArray(), K, image.size(), CV_32FC1, expected1, expected2);
    fs.open(folder / "maps.yml", cv::FileStorage::READ);
    fs["map1"] >> map1;
    fs["map2"] >> map2;
    EXPECT_LT(cv::norm(map1, expected1, cv::NORM_INF), 1e-3);
    EXPECT_LT(cv::norm(map2, expected2, cv::NORM_INF), 1e-3);
}

// The type of an image is kept, and what is seen in it is the same.
class CorrectKeeps : public testing::TestWithParam<int>
{
public:
    static cv::Mat convert(const cv::Mat& image, int type)
    {
        cv::Mat result = image.clone();
        if (CV_MAT_CN(type) == 1)
            cv::cvtColor(result, result, cv::COLOR_BGR2GRAY);
        else if (CV_MAT_CN(type) == 4)
            cv::cvtColor(result, result, cv::COLOR_BGR2BGRA);
        if (CV_MAT_DEPTH(type) == CV_16U)
            result.convertTo(result, CV_16U, 257);
        return result;
    }
};

TEST_P(CorrectKeeps, type)
{
    const TemporaryFolder folder;
    const cv::Mat image = convert(streetImage(), GetParam());
    cv::imwrite(folder / "in.png", image);
    Arguments arguments =
        streetArguments() + Arguments{"--output=" + (folder / "out.png"), "--overlay=" + (folder / "overlay.png"),
                                      "--report=-", "--maps=" + (folder / "maps.yml")};
    arguments[0] = folder / "in.png";
    const Outcome outcome = correct(arguments);
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    EXPECT_EQ("ok", Json::parse(outcome.output)["status"]);
    cv::Mat map1, map2, expected;
    cv::FileStorage fs(folder / "maps.yml", cv::FileStorage::READ);
    fs["map1"] >> map1;
    fs["map2"] >> map2;
    cv::remap(image, expected, map1, map2, cv::INTER_LINEAR);
    EXPECT_TRUE(isSame(expected, cv::imread(folder / "out.png", cv::IMREAD_UNCHANGED)));
    EXPECT_EQ(CV_8UC3, cv::imread(folder / "overlay.png", cv::IMREAD_UNCHANGED).type());
}

INSTANTIATE_TEST_CASE_P(Correct, CorrectKeeps,
                        testing::Values(CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1, CV_16UC3, CV_16UC4));

TEST(Correct, format_that_cannot_hold_the_type)
{
    const TemporaryFolder folder;
    cv::imwrite(folder / "in.png", CorrectKeeps::convert(streetImage(), CV_16UC3));
    for (const char* name : {"out.jpg", "out.bmp"})
        EXPECT_EQ(1, correct({folder / "in.png", "--output=" + (folder / name)}).exitCode) << name;
    EXPECT_EQ(std::vector<std::string>{"in.png"}, namesIn(folder.path()));
}

TEST(Evaluate, compares_with_the_truth)
{
    const TemporaryFolder folder;
    ASSERT_EQ(0, correct(streetArguments() + Arguments{"--gravity_sigma=0", "--report=" + (folder / "report.jsonl"),
                                                       "--maps=" + (folder / "maps.yml")})
                     .exitCode);
    // Editors add blank lines.
    writeContent(folder / "report.jsonl", "\n" + contentOf(folder / "report.jsonl") + " \r\n\n");
    const Outcome exported =
        runProgram(EXPORT_PROGRAM, {"--report=" + (folder / "report.jsonl"), "--row_poses=" + (folder / "rows")});
    EXPECT_EQ(0, exported.exitCode) << exported.messages;
    const Outcome outcome = evaluate({"--truth=" + streetFolder() + "/truth.json",
                                      "--report=" + (folder / "report.jsonl"), "--maps=" + (folder / "maps.yml")});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    double before = 0, after = 0;
    const size_t at = outcome.output.find("mean displacement, px");
    ASSERT_NE(std::string::npos, at);
    ASSERT_EQ(2, std::sscanf(outcome.output.c_str() + at, "mean displacement, px %lf %lf", &before, &after));
    EXPECT_GT(before, 2);
    EXPECT_LT(after, 0.45);
    EXPECT_EQ(2, evaluate({"--truth=x"}).exitCode);
    EXPECT_EQ(1,
              evaluate({"--truth=/no/such", "--report=" + (folder / "report.jsonl"), "--maps=" + (folder / "maps.yml")})
                  .exitCode);
    EXPECT_EQ(1, evaluate({"--truth=" + streetFolder() + "/truth.json", "--report=" + (folder / "maps.yml"),
                           "--maps=" + (folder / "maps.yml")})
                     .exitCode);
    // Maps of another motion, and of an input that has failed.
    const std::pair<Arguments, const char*> others[] = {
        {{"--model=none"}, "maps.yml isn't of rolling.png, the last input of"},
        {{"--scan=bottom_to_top"}, "maps.yml isn't of rolling.png, the last input of"},
        {{folder / "missing.png"}, "has failed"}};
    for (const auto& other : others)
    {
        correct(streetArguments() + other.first + Arguments{"--report=" + (folder / "other.jsonl"), "--overwrite"});
        const Outcome refused = evaluate({"--truth=" + streetFolder() + "/truth.json",
                                          "--report=" + (folder / "other.jsonl"), "--maps=" + (folder / "maps.yml")});
        EXPECT_EQ(1, refused.exitCode);
        EXPECT_NE(std::string::npos, refused.messages.find(other.second)) << refused.messages;
    }
}

// OpenCV's backends would say so.
TEST(Correct, more_threads_than_processors)
{
    const Outcome outcome = correct({streetFolder() + "/rolling.png", "--report=-", "--threads=4096"});
    EXPECT_EQ(0, outcome.exitCode);
    EXPECT_EQ("", outcome.messages);
}

TEST(Correct, given_values_that_the_image_contradicts)
{
    const TemporaryFolder folder;
    const std::string report = folder / "report.jsonl";
    const auto run = [&](const Arguments& options) {
        Arguments all = {streetFolder() + "/rolling.png", "--camera=" + streetFolder() + "/camera.yml",
                         "--report=" + report, "--overwrite"};
        all.insert(all.end(), options.begin(), options.end());
        const Outcome outcome = correct(all);
        EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
        return outcome.messages;
    };
    ASSERT_EQ("", run({"--wall=2.5"}));
    const double speed = reportOf(report)["speed_km_h"];
    EXPECT_TRUE(reportOf(report)["seen_speed_km_h"].is_null());
    ASSERT_GT(speed, 20);

    EXPECT_EQ("", run({"--wall=2.5", cv::format("--speed=%.3f", speed)}));
    EXPECT_EQ(false, reportOf(report)["contradicts_prior"]);
    EXPECT_NEAR(speed, reportOf(report)["seen_speed_km_h"].get<double>(), 3);

    const std::string reverse = cv::format("--speed=%.3f", -speed);
    const std::string withWall = run({"--wall=2.5", reverse});
    EXPECT_EQ(true, reportOf(report)["contradicts_prior"]);
    for (const std::string& part :
         {std::string("rolling.png"), cv::format("%.1f km/h (sigma 2.0)", -speed),
          cv::format("the image shows %.1f (sigma", reportOf(report)["seen_speed_km_h"].get<double>())})
        EXPECT_NE(std::string::npos, withWall.find(part)) << withWall;

    const std::string withoutWall = run({reverse});
    EXPECT_EQ(true, reportOf(report)["contradicts_prior"]);
    EXPECT_NE(std::string::npos, withoutWall.find("the other direction")) << withoutWall;

    const std::string yawRate = run({"--yaw_rate=90", "--gravity_sigma=0"});
    EXPECT_EQ(true, reportOf(report)["contradicts_prior"]);
    EXPECT_NE(std::string::npos, yawRate.find("yaw rate of 90.0 deg/s (sigma 1.0)")) << yawRate;
}

}} // namespace
