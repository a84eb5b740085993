// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Cameras that shake: what is simulated of them, and that a gyro helps against it.

#include "program.hpp"
#ifdef RSACKERMANN_WITH_VIDEOIO
#include "opencv2/videoio.hpp"
#endif
#include "gyro_file.hpp"
#include "rendered_drive.hpp"
#include "simulated_gyro.hpp"
#include "truth_file.hpp"

#include "opencv2/imgproc.hpp"

namespace opencv_test { namespace {

using nlohmann::json;
using street::Shake;

const double DEGREE = CV_PI / 180;

class ShakeOfAKind : public testing::TestWithParam<int>
{
};

// The rates have the size that is asked for, and oscillate as fast as what excites them.
TEST_P(ShakeOfAKind, rates)
{
    const double rate = 5 * DEGREE, step = 1e-3, seconds = 60;
    const struct
    {
        double lowest, highest; // Hz
    } bands[] = {{0, 0}, {0.7, 3}, {20, 40}, {4, 12}};
    street::StreetCamera camera(cv::Size(64, 38), 80, 1e-5, 1.2);
    camera.shake = Shake(GetParam(), rate, 3);
    double squares = 0, last = 0;
    int crossings = 0;
    for (camera.seconds = 0; camera.seconds < seconds; camera.seconds += step)
    {
        const double pitch = street::turnRates(camera, 0)[0];
        squares += pitch * pitch * step / seconds;
        crossings += pitch * last < 0;
        last = pitch;
    }
    EXPECT_NEAR(rate, std::sqrt(squares), 0.1 * rate);
    EXPECT_GT(crossings / 2 / seconds, bands[GetParam()].lowest);
    EXPECT_LT(crossings / 2 / seconds, bands[GetParam()].highest);
}

INSTANTIATE_TEST_CASE_P(Samples, ShakeOfAKind, testing::Values(Shake::SUSPENSION, Shake::ENGINE, Shake::PHONE));

TEST(Shaking, same_for_the_same_seed)
{
    const Shake a(Shake::PHONE, 0.2, 1), b(Shake::PHONE, 0.2, 1), other(Shake::PHONE, 0.2, 2);
    EXPECT_EQ(a.rotation(1.5), b.rotation(1.5));
    EXPECT_GT(cv::norm(a.rotation(1.5) - other.rotation(1.5)), 1e-4);
    EXPECT_LT(cv::norm(a.rotation(1.5) - a.heldAt(1.5).rotation(7)), 1e-12);
    EXPECT_EQ(cv::Matx33d::eye(), Shake().rotation(1.5));
    EXPECT_EQ(cv::Matx33d::eye(), Shake(Shake::ENGINE, 0, 1).rotation(1.5));
}

// Small turns one after another are the turn from the first instant to the last one, and the car's yaw is about the
// vertical.
TEST(Shaking, rates_are_those_of_the_turns)
{
    street::StreetCamera camera(cv::Size(64, 38), 80, 1e-5, 1.2);
    camera.roll = 5 * DEGREE;
    camera.pitch = -10 * DEGREE;
    const cv::Vec3d rest = street::turnRates(camera, 0.3);
    EXPECT_NEAR(0.3, cv::norm(rest), 1e-12);
    EXPECT_NEAR(0.3 * std::sin(camera.pitch), rest[2], 0.002);
    camera.shake = Shake(Shake::PHONE, 0.4, 1);
    const double step = 1e-4;
    cv::Matx33d turned = camera.shake.rotation(0);
    for (int i = 0; i < 5000; i++)
    {
        camera.seconds = (i + 0.5) * step;
        const cv::Vec3d v = street::turnRates(camera, 0) * step;
        const cv::Matx33d cross(0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0);
        turned = turned * (cv::Matx33d::eye() + cross + cross * cross * 0.5);
    }
    EXPECT_LT(cv::norm(turned - camera.shake.rotation(5000 * step)), 1e-6);
}

// Of what is infinitely far away the rows see what they have turned to.
TEST(Shaking, rows_of_a_standing_camera)
{
    street::StreetCamera camera(cv::Size(320, 190), 408, 0.02 / 190, 1.2);
    camera.shake = Shake(Shake::PHONE, 0.5, 1);
    camera.seconds = 2.3;
    street::StreetScene scene;
    scene.left = scene.right = 0;
    const street::StreetRenderer renderer(camera, scene);
    const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
    double farthest = 0;
    for (int y = 0; y < 60; y += 10) // the sky
        for (int x = 0; x < camera.size.width; x += 20)
        {
            const cv::Matx33d turn = camera.shake.rotation(camera.seconds).t() *
                                     camera.shake.rotation(camera.seconds + (y - camera.reference) * camera.lineDelay);
            const cv::Vec3d expected = K * turn * K.inv() * cv::Vec3d(x, y, 1);
            cv::Point2d global, back;
            ASSERT_TRUE(renderer.toGlobal(cv::Point2d(x, y), global));
            EXPECT_NEAR(expected[0] / expected[2], global.x, 1e-9);
            EXPECT_NEAR(expected[1] / expected[2], global.y, 1e-9);
            ASSERT_TRUE(renderer.toRolling(global, back));
            EXPECT_LT(cv::norm(back - cv::Point2d(x, y)), 1e-5);
            farthest = std::max(farthest, cv::norm(global - cv::Point2d(x, y)));
        }
    EXPECT_GT(farthest, 1);
}

// Through the files, too: the truth suffices to make the true map.
TEST(Shaking, image_of_the_program)
{
    const TemporaryFolder folder;
    ASSERT_EQ(0, simulate({"--output=" + folder.path(), "--shake=phone", "--shake_rate=60", "--speed=0", "--yaw_rate=0",
                           "--noise=0", "--size=320x190", "--focal=408"})
                     .exitCode);
    const rsackermann_samples::Truth truth = rsackermann_samples::readTruth(folder / "truth.json");
    EXPECT_NEAR(60 * DEGREE, truth.camera.shake.rate(), 1e-12);
    cv::Mat rolling = cv::imread(folder / "rolling.png"), global = cv::imread(folder / "global.png"), columns, rows,
            mask, rectified;
    street::StreetRenderer(truth.camera, truth.scene).rectifyMap(columns, rows, mask);
    cv::remap(rolling, rectified, columns, rows, cv::INTER_LINEAR);
    for (cv::Mat* image : {&rolling, &global, &rectified})
        cv::GaussianBlur(*image, *image, cv::Size(), 1); // what is finer than a pixel looks different
    cv::erode(mask, mask, cv::Mat(), cv::Point(-1, -1), 4);
    EXPECT_LT(cv::norm(rectified, global, cv::NORM_L1, mask), 0.5 * cv::norm(rolling, global, cv::NORM_L1, mask));
    json old = json::parse(contentOf(folder / "truth.json"));
    for (const std::pair<const char*, json>& bad :
         {std::pair<const char*, json>("shake", "dance"), {"shake_rate_deg_s", -1}, {"shake_seed", -1}})
    {
        json damaged = old;
        damaged[bad.first] = bad.second;
        writeContent(folder / "bad.json", damaged.dump());
        EXPECT_ANY_THROW(rsackermann_samples::readTruth(folder / "bad.json")) << bad.first;
    }
    for (const char* key : {"shake", "time_s", "travelled_m"}) // as of before 0.2
        old.erase(key);
    writeContent(folder / "old.json", old.dump());
    EXPECT_EQ(Shake::NONE, rsackermann_samples::readTruth(folder / "old.json").camera.shake.kind());
}

const Arguments SHORT = {"--size=160x95", "--focal=200", "--samples=1", "--speed=30", "--left=6", "--right=6"};

Outcome simulateDrive(const std::string& output, const Arguments& options)
{
    Arguments all = {"--output=" + output};
    all.insert(all.end(), options.begin(), options.end());
    all.insert(all.end(), SHORT.begin(), SHORT.end());
    return simulate(all);
}

std::vector<json> truthOf(const std::string& file)
{
    std::vector<json> lines;
    for (const std::string& line : linesOf(file))
        lines.push_back(json::parse(line));
    return lines;
}

TEST(SimulatedDrive, files)
{
    const TemporaryFolder folder;
    ASSERT_EQ(0, simulateDrive(folder / "a", {"--frames=12", "--shake=phone", "--gyro_rate=2000", "--gyro_noise=0",
                                              "--gyro_bias=0.5", "--gyro_delay=3"})
                     .exitCode);
    EXPECT_EQ((std::vector<std::string>{"camera.yml", "frames", "gyro.csv", "log.csv", "truth.jsonl"}),
              namesIn(folder / "a"));
    EXPECT_EQ(12u, namesIn(folder / "a/frames").size());
    EXPECT_EQ("000001.png,0.033333333", linesOf(folder / "a/log.csv")[2]);
    const std::vector<json> truth = truthOf(folder / "a/truth.jsonl");
    ASSERT_EQ(12u, truth.size());
    const rsackermann_samples::GyroRecording gyro = rsackermann_samples::readGyro(folder / "a/gyro.csv", "test");
    double largest = 0;
    for (int i = 0; i < 12; i++)
    {
        EXPECT_EQ(namesIn(folder / "a/frames")[size_t(i)], truth[size_t(i)]["file"]);
        EXPECT_NEAR(i / 30., truth[size_t(i)]["time_s"].get<double>(), 1e-12);
        int k = 0; // the sample nearest to the frame
        while (gyro.times.at<double>(k) < i / 30. + 3 - 0.00025)
            k++;
        const char* const names[] = {"camera_pitch_rate_deg_s", "camera_yaw_rate_deg_s", "camera_roll_rate_deg_s"};
        for (int axis = 0; axis < 3; axis++)
        {
            const double shown = gyro.rates.at<double>(k, axis) / DEGREE - 0.5, sign = axis == 0 ? -1 : 1;
            EXPECT_NEAR(truth[size_t(i)][names[axis]].get<double>(), sign * shown, 0.3) << i << ", " << axis;
            largest = std::max(largest, std::abs(shown));
        }
    }
    EXPECT_GT(largest, 10);
    // The same seed makes the same files.
    ASSERT_EQ(0, simulateDrive(folder / "b", {"--frames=3", "--shake=engine"}).exitCode);
    ASSERT_EQ(0, simulateDrive(folder / "c", {"--frames=3", "--shake=engine"}).exitCode);
    ASSERT_EQ(0, simulateDrive(folder / "d", {"--frames=3", "--shake=engine", "--seed=1"}).exitCode);
    for (const char* name : {"/gyro.csv", "/truth.jsonl", "/frames/000002.png"})
    {
        EXPECT_EQ(contentOf(folder / "b" + name), contentOf(folder / "c" + name));
        EXPECT_NE(contentOf(folder / "b" + name), contentOf(folder / "d" + name));
    }
}

TEST(SimulatedDrive, refusals)
{
    const TemporaryFolder folder;
    const auto expectRefused = [&](int code, const Arguments& options, const std::string& part) {
        const Outcome outcome = simulateDrive(folder / "out", options);
        EXPECT_EQ(code, outcome.exitCode) << part;
        EXPECT_NE(std::string::npos, outcome.messages.find(part)) << outcome.messages;
    };
    expectRefused(2, {"--frames=0"}, "frames");
    expectRefused(2, {"--frames=3", "--shake=dance"}, "shake");
    expectRefused(2, {"--frames=3", "--shake_rate=3"}, "--shake_rate needs --shake");
    expectRefused(2, {"--gyro_bias=1"}, "--gyro_bias needs --frames");
    expectRefused(2, {"--frames=3", "--gyro_rate=0"}, "gyro_rate");
    expectRefused(2, {"--frames=3", "--gyro_noise=-1"}, "gyro_noise");
    for (const char* turn : {"--yaw_rate=120", "--yaw_rate=-120"}) // to either wall
        expectRefused(2, {"--frames=60", turn}, "reaches a wall after 0.83 s");
    EXPECT_TRUE(namesIn(folder.path()).empty());
    EXPECT_EQ(
        2,
        simulate({"--output=" + (folder / "out"), "--image=" + streetFolder() + "/global.png", "--frames=3"}).exitCode);
    ASSERT_EQ(0, simulateDrive(folder / "out", {"--frames=2"}).exitCode);
    expectRefused(1, {"--frames=2"}, "exists (--overwrite replaces it)");
    expectRefused(1, {"--frames=1", "--overwrite"}, "000001.png is of a longer drive");
    EXPECT_EQ(0, simulateDrive(folder / "out", {"--frames=3", "--overwrite"}).exitCode);
}

// Root mean square over the frames but the first ones, deg/s.
double errorOfRates(const std::vector<json>& truth, const std::string& report)
{
    const std::vector<std::string> lines = linesOf(report);
    EXPECT_EQ(truth.size(), lines.size());
    const size_t first = 8;
    double squares = 0;
    for (size_t i = first; i < lines.size(); i++)
    {
        const json found = json::parse(lines[i]);
        for (const char* axis : {"yaw", "pitch", "roll"})
        {
            const std::string key = std::string(axis) + "_rate_deg_s";
            const double value = found[key].is_null() ? 0 : found[key].get<double>();
            squares += std::pow(value - truth[i]["camera_" + key].get<double>(), 2);
        }
    }
    return std::sqrt(squares / double(lines.size() - first));
}

// A table of a gyro on a clock that is ahead by some more seconds.
std::string delayed(const std::string& path, double seconds)
{
    const std::vector<std::string> lines = linesOf(path);
    std::string text = lines[0] + "\n";
    for (size_t i = 1; i < lines.size(); i++)
        text += cv::format("%.6f", std::stod(lines[i]) + seconds) + lines[i].substr(lines[i].find(',')) + "\n";
    return text;
}

// A gyro with a bias, noise and a clock that is off: the points show them.
class GyroOfDrive : public testing::Test
{
protected:
    const TemporaryFolder folder;
    std::vector<json> truth;
    Arguments drive; // as images

    void SetUp() CV_OVERRIDE
    {
        ASSERT_EQ(0, simulate({"--output=" + (folder / "drive"), "--frames=30", "--shake=phone", "--size=480x286",
                               "--focal=612", "--samples=1", "--speed=40", "--left=6", "--right=8", "--readout=0.025",
                               "--gyro_bias=0.5", "--gyro_delay=0.006"})
                         .exitCode);
        truth = truthOf(folder / "drive/truth.jsonl");
        drive = {folder / "drive/frames", "--log=" + (folder / "drive/log.csv")};
        writeContent(folder / "later.csv", delayed(folder / "drive/gyro.csv", 1));
    }

    double errorWith(const Arguments& input, const std::string& gyro) const
    {
        Arguments arguments = {"--carry", "--camera=" + (folder / "drive/camera.yml"),
                               "--report=" + (folder / "report.jsonl"), "--overwrite"};
        arguments.insert(arguments.end(), input.begin(), input.end());
        if (!gyro.empty())
            arguments.push_back("--gyro=" + (folder / gyro));
        const Outcome outcome = correct(arguments);
        EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
        return errorOfRates(truth, folder / "report.jsonl");
    }
};

TEST_F(GyroOfDrive, gives_the_rates_of_rows)
{
    const double error = errorWith(drive, "drive/gyro.csv");
    EXPECT_LT(error, 2);
    EXPECT_GT(errorWith(drive, ""), 3 * error);
}

// No frame has to wait until it is known.
TEST_F(GyroOfDrive, clock_is_found_before_the_first_frame)
{
    EXPECT_LT(errorWith(drive, "later.csv"), 2);
#ifdef RSACKERMANN_WITH_VIDEOIO
    std::vector<cv::String> frames;
    cv::glob(folder / "drive/frames", frames);
    {
        cv::VideoWriter video(folder / "drive.avi", cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 30,
                              cv::imread(frames[0]).size());
        for (const cv::String& frame : frames)
            video.write(cv::imread(frame));
    }
    // Images after a video have a clock of their own again: here the gyro's is ahead of it by half a second.
    std::string log = "file,time_s\n";
    for (size_t i = 0; i < frames.size(); i++)
        log += frames[i] + cv::format(",%.9f\n", 0.5 + double(i) / 30);
    writeContent(folder / "images.csv", log);
    std::vector<json> all(1, truth[0]);
    for (int k = 0; k < 2; k++)
        all.insert(all.end(), truth.begin(), truth.end());
    truth = all;
    EXPECT_LT(errorWith({frames[0], folder / "drive.avi", folder / "drive/frames", "--log=" + (folder / "images.csv")},
                        "later.csv"),
              2);
#endif
}

// The samples of a drive in another unit, or about other axes.
std::string scaledGyro(const std::string& drive, double factor, bool isTurned = false)
{
    std::string scaled;
    for (const std::string& line : linesOf(drive + "/gyro.csv"))
    {
        double time = 0, a = 0, b = 0, r = 0;
        if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &time, &a, &b, &r) != 4)
            scaled += line + "\n";
        else
            scaled += cv::format("%.6f,%.9g,%.9g,%.9g\n", time, factor * (isTurned ? -b : a),
                                 factor * (isTurned ? r : b), factor * (isTurned ? a : r));
    }
    return scaled;
}

// What is wrong is said as far as the rates of the points show it.
TEST_F(GyroOfDrive, contradiction_has_a_reason)
{
    const struct
    {
        double factor;
        bool isTurned;
        const char* reason;
    } cases[] = {{180 / CV_PI, false, "degrees that are read as radians"},
                 {CV_PI / 180, false, "radians that are read as degrees"},
                 {1, true, "its axes or clock may be others, or --scan"}};
    for (const auto& c : cases)
    {
        writeContent(folder / "wrong.csv", scaledGyro(folder / "drive", c.factor, c.isTurned));
        const Outcome outcome = correct(drive + Arguments{"--carry", "--camera=" + (folder / "drive/camera.yml"),
                                                          "--report=-", "--gyro=" + (folder / "wrong.csv")});
        EXPECT_EQ(0, outcome.exitCode);
        const size_t at = outcome.messages.find("the images contradict the gyro");
        EXPECT_NE(std::string::npos, outcome.messages.find(c.reason, at)) << outcome.messages;
        EXPECT_EQ(at, outcome.messages.rfind("the images contradict the gyro")) << outcome.messages;
    }
}

// Between frames an engine shakes to and fro, which points don't show: that is no reason to doubt the unit.
TEST_F(GyroOfDrive, engine_that_shakes_much)
{
    const std::string shaken = folder / "engine";
    ASSERT_EQ(0, simulate({"--output=" + shaken, "--frames=16", "--speed=40", "--left=6", "--right=8", "--shake=engine",
                           "--shake_rate=80"})
                     .exitCode);
    for (const double factor : {1., 180 / CV_PI, CV_PI / 180})
    {
        SCOPED_TRACE(factor);
        writeContent(folder / "scaled.csv", scaledGyro(shaken, factor));
        const Outcome outcome =
            correct({shaken + "/frames", "--log=" + shaken + "/log.csv", "--camera=" + shaken + "/camera.yml",
                     "--carry", "--report=-", "--gyro=" + (folder / "scaled.csv")});
        EXPECT_EQ(0, outcome.exitCode);
        EXPECT_EQ(factor > 2, outcome.messages.find("degrees that are read as radians") != std::string::npos)
            << outcome.messages;
        EXPECT_EQ(factor < 0.5, outcome.messages.find("radians that are read as degrees") != std::string::npos)
            << outcome.messages;
    }
}

// Points hardly tell a turn of a camera that looks sideways from its way, and don't contradict a gyro that does.
TEST_F(GyroOfDrive, sideways)
{
    const std::string sideways = folder / "sideways";
    ASSERT_EQ(0, simulate({"--output=" + sideways, "--frames=40", "--size=480x300", "--focal=500", "--speed=30",
                           "--heading=-80", "--left=5", "--right=6", "--samples=2", "--shake=phone", "--readout=0.02",
                           "--seed=0"})
                     .exitCode);
    const Outcome outcome =
        correct({sideways + "/frames", "--log=" + sideways + "/log.csv", "--camera=" + sideways + "/camera.yml",
                 "--carry", "--report=" + (folder / "report.jsonl"), "--gyro=" + sideways + "/gyro.csv"});
    EXPECT_EQ(0, outcome.exitCode);
    EXPECT_EQ(std::string::npos, outcome.messages.find("contradict the gyro")) << outcome.messages;
    int used = 0;
    for (const json& frame : truthOf(folder / "report.jsonl"))
        used += !frame["rotation_curve"].is_null();
    EXPECT_GE(used, 38);
}

}} // namespace
