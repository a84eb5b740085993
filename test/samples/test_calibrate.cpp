// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "camera_file.hpp"
#include "program.hpp"
#include "street_renderer.hpp"

#include <fstream>

namespace opencv_test { namespace {

using rsackermann_samples::CameraSettings;

const double DEGREE = CV_PI / 180;
const cv::Size SIZE(480, 300);
const double FOCAL = 400, LINE_DELAY = 0.025 / 300, INTERVAL = 1 / 30.;

Outcome calibrate(const Arguments& arguments)
{
    return runProgram(CALIBRATE_PROGRAM, arguments);
}

CameraSettings readCamera(const std::string& path)
{
    CameraSettings settings;
    rsackermann_samples::readCameraFile(path, settings);
    return settings;
}

//! Rendered drives of a camera with roll 1.2, pitch -0.8 and heading 1.5 degrees, and a log with times and yaw rates.
class Calibrate : public testing::Test
{
protected:
    Calibrate() : output_(folder_ / "calibrated.yml")
    {
        writeCamera("camera.yml", 0.8 * LINE_DELAY);
        log_ = "file,time_s,yaw_rate_deg_s,yaw_rate_sigma_deg_s\n";
    }

    //! What is known before. @param lineDelay 0: unknown.
    void writeCamera(const std::string& name, double lineDelay, bool isMountGiven = true) const
    {
        CameraSettings camera;
        camera.size = SIZE;
        camera.calibrated = true;
        camera.K = cv::Matx33d(FOCAL, 0, (SIZE.width - 1) / 2., 0, FOCAL, (SIZE.height - 1) / 2., 0, 0, 1);
        camera.lineDelay = lineDelay;
        camera.height = 1.4;
        camera.rollIsGiven = camera.pitchIsGiven = isMountGiven;
        rsackermann_samples::writeCameraFile(folder_ / name, camera);
    }

    //! Adds the frames of a bend; the car is in the middle of the street in the middle of the drive.
    void addBend(double yawRate, double begin, int frames)
    {
        street::StreetCamera camera(SIZE, FOCAL, LINE_DELAY, 1.4);
        camera.roll = 1.2 * DEGREE;
        camera.pitch = -0.8 * DEGREE;
        camera.heading = 1.5 * DEGREE;
        street::StreetScene scene;
        scene.yawRate = yawRate * DEGREE;
        scene.speed = 10;
        scene.left = 6;
        scene.right = 7;
        scene.wallDirection = camera.heading;
        scene.seed = unsigned(begin);
        scene.noise = 0; // it would be the same in all frames
        for (int i = 0; i < frames; i++)
        {
            // A line far before the image is the one at whose instant the car was where the renderer has its origin.
            const double seconds = (i - frames / 2) * INTERVAL;
            camera.reference = (SIZE.height - 1) / 2. - seconds / LINE_DELAY;
            const std::string path = folder_ / cv::format("%03d.png", int(inputs_.size()));
            cv::imwrite(path, street::StreetRenderer(camera, scene).rollingShutter(1));
            inputs_.push_back(path);
            log_ += path + cv::format(",%.6f,%g,0.3\n", begin + i * INTERVAL, yawRate);
        }
    }

    Outcome run(const Arguments& options = {}) const
    {
        writeContent(folder_ / "log.csv", log_);
        Arguments arguments = inputs_;
        for (const std::string& option :
             {"--camera=" + (folder_ / "camera.yml"), "--output=" + output_, "--log=" + (folder_ / "log.csv")})
            arguments.push_back(option);
        arguments.insert(arguments.end(), options.begin(), options.end());
        return calibrate(arguments);
    }

    const TemporaryFolder folder_;
    const std::string output_;
    Arguments inputs_;
    std::string log_;
};

TEST_F(Calibrate, bends_tell_mount_and_line_delay)
{
    writeCamera("camera.yml", 0);
    const double bends[] = {40, -40, 25, -25};
    for (int i = 0; i < 4; i++)
        addBend(bends[i], 10 * i, 12);
    const Outcome outcome = run();
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    EXPECT_EQ(std::string::npos, outcome.output.find("not observable")) << outcome.output;
    const CameraSettings c = readCamera(output_);
    EXPECT_NEAR(1.2, c.roll, 0.3) << outcome.output;
    EXPECT_NEAR(-0.8, c.pitch, 0.3) << outcome.output;
    EXPECT_NEAR(1.5, c.heading, 0.5) << outcome.output;
    EXPECT_NEAR(LINE_DELAY, c.lineDelay, 0.15 * LINE_DELAY) << outcome.output;
    EXPECT_NEAR(1.2, c.roll, 3 * c.rollSigma);
    EXPECT_NEAR(-0.8, c.pitch, 3 * c.pitchSigma);
    EXPECT_NEAR(1.5, c.heading, 3 * c.headingSigma);
    EXPECT_NEAR(LINE_DELAY, c.lineDelay, 3 * c.lineDelaySigma);
    EXPECT_EQ(1.4, c.height);
    EXPECT_EQ(SIZE, c.size);

    // rsackermann_correct reads it, and its options go before.
    const Outcome byFile = correct({inputs_[0], "--camera=" + output_, "--report=-", "--gravity_sigma=1"});
    const Arguments options = {inputs_[0],
                               "--camera=" + (folder_ / "camera.yml"),
                               "--report=-",
                               "--gravity_sigma=1",
                               cv::format("--roll=%.17g", c.roll),
                               cv::format("--pitch=%.17g", c.pitch),
                               cv::format("--heading=%.17g", c.heading),
                               cv::format("--line_delay=%.17g", c.lineDelay)};
    const Outcome byOptions = correct(options);
    ASSERT_EQ(0, byFile.exitCode) << byFile.messages;
    ASSERT_EQ(0, byOptions.exitCode) << byOptions.messages;
    EXPECT_EQ(nlohmann::json::parse(byFile.output)["alpha"], nlohmann::json::parse(byOptions.output)["alpha"]);
}

TEST_F(Calibrate, straight_drive_leaves_the_line_delay)
{
    addBend(0, 0, 15);
    const Outcome outcome = run();
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    EXPECT_NE(std::string::npos, outcome.output.find("line delay  not observable")) << outcome.output;
    EXPECT_NE(std::string::npos, outcome.output.find("read in another order (--scan)")) << outcome.output;
    const CameraSettings c = readCamera(output_);
    EXPECT_NEAR(0.8 * LINE_DELAY, c.lineDelay, 1e-12);
    EXPECT_EQ(0, c.lineDelaySigma); // as it was
    EXPECT_NEAR(1.5, c.heading, 0.5);
    EXPECT_GT(c.headingSigma, 0);
}

TEST_F(Calibrate, focal_length_takes_the_place_of_a_camera_file)
{
    addBend(0, 0, 15);
    writeContent(folder_ / "log.csv", log_);
    Arguments arguments = inputs_;
    for (const std::string& option :
         {std::string("--focal=500"), std::string("--height=1.4"), cv::format("--line_delay=%.17g", LINE_DELAY),
          "--output=" + output_, "--log=" + (folder_ / "log.csv")})
        arguments.push_back(option);
    const Outcome outcome = calibrate(arguments);
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    const CameraSettings c = readCamera(output_);
    EXPECT_EQ(500, c.K(0, 0));
    EXPECT_NEAR(0.05 * 500, c.focalSigma, 1e-9);
    EXPECT_EQ(SIZE, c.size);
    EXPECT_NEAR(LINE_DELAY, c.lineDelay, 1e-12);
}

// Milliseconds that are printed.
double gyroDelay(const std::string& output)
{
    const std::string name = "gyro delay ";
    const size_t at = output.find(name);
    EXPECT_NE(std::string::npos, at) << output;
    return at == std::string::npos ? -1 : std::stod(output.substr(at + name.size()));
}

// A phone on an arm, on a straight drive of a second: no bend shows the line delay. The clock of the gyro is 10 ms
// ahead.
TEST_F(Calibrate, shaking_and_a_gyro_show_the_line_delay)
{
    const std::string drive = folder_ / "drive";
    ASSERT_EQ(0, simulate({"--output=" + drive, "--frames=30", "--speed=40", "--yaw_rate=0", "--left=6", "--right=8",
                           "--shake=phone", "--gyro_bias=0.5", "--gyro_delay=0.01"})
                     .exitCode);
    CameraSettings camera = readCamera(drive + "/camera.yml");
    const double lineDelay = camera.makeCamera(camera.size).lineDelay;
    camera.readOut *= 0.7; // which the line delay replaces
    rsackermann_samples::writeCameraFile(folder_ / "readout.yml", camera);
    const Arguments given = {drive + "/frames", "--camera=" + (folder_ / "readout.yml"), "--log=" + drive + "/log.csv",
                             "--output=" + output_, "--overwrite"};
    Arguments arguments = given;
    arguments.push_back("--gyro=" + drive + "/gyro.csv");
    Outcome outcome = calibrate(arguments);
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    const CameraSettings c = readCamera(output_);
    EXPECT_NEAR(lineDelay, c.lineDelay, 3 * c.lineDelaySigma);
    EXPECT_LT(c.lineDelaySigma, 0.02 * lineDelay);
    EXPECT_NE(std::string::npos, outcome.output.find("used in 29 frames")) << outcome.output;
    EXPECT_NEAR(10, gyroDelay(outcome.output), 0.5);
    // Without a log the first image is at 0, where the renderer's clock begins.
    // The focal length of the file isn't exact, and the gyro shows a better one.
    const double focal = camera.K(0, 0);
    camera.K(0, 0) *= 1.04;
    camera.K(1, 1) *= 1.04;
    camera.focalSigma = 0.05 * focal;
    rsackermann_samples::writeCameraFile(folder_ / "focal.yml", camera);
    Arguments untimed = arguments;
    untimed.erase(untimed.begin() + 2);
    untimed[1] = "--camera=" + (folder_ / "focal.yml");
    outcome = calibrate(untimed);
    EXPECT_NE(std::string::npos, outcome.output.find("used in 29 frames")) << outcome.output << outcome.messages;
    EXPECT_NEAR(10, gyroDelay(outcome.output), 0.5);
    const CameraSettings found = readCamera(output_);
    EXPECT_NEAR(focal, found.K(0, 0), 0.02 * focal);
    EXPECT_NEAR(focal, found.K(0, 0), 3 * found.focalSigma);
    // In another order rows show none of the shaking.
    Arguments upwards = arguments;
    upwards.push_back("--scan=bottom_to_top");
    outcome = calibrate(upwards);
    EXPECT_NE(std::string::npos, outcome.output.find("read in another order (--scan)")) << outcome.output;
    arguments.push_back("--gyro_delay=0.01");
    outcome = calibrate(arguments);
    EXPECT_NEAR(0, gyroDelay(outcome.output), 0.5);
    // One that measures something else, and none.
    arguments = given;
    writeContent(folder_ / "still.csv",
                 "time_s,yaw_rate_deg_s,pitch_rate_deg_s,roll_rate_deg_s\n-1,0,0,0\n-0.95,0,0,0\n");
    arguments.push_back("--gyro=" + (folder_ / "still.csv"));
    outcome = calibrate(arguments);
    EXPECT_EQ(0, outcome.exitCode);
    EXPECT_NE(std::string::npos, outcome.messages.find("contradict the gyro")) << outcome.messages;
    EXPECT_EQ(std::string::npos, outcome.output.find("gyro delay")) << outcome.output;
}

// Along lane lines and kerbs points stay with the stairs of the edge rather than the road, which at 8 km/h hardly
// moves.
TEST_F(Calibrate, slow_drives_are_not_misled_by_edges)
{
    const std::string drive = folder_ / "drive";
    ASSERT_EQ(0, simulate({"--output=" + drive, "--frames=26", "--speed=8", "--readout=0.025", "--seed=51"}).exitCode);
    const double lineDelay = 0.025 / 380;
    const Outcome outcome = calibrate(
        {drive + "/frames", "--camera=" + drive + "/camera.yml", "--log=" + drive + "/log.csv", "--output=" + output_});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    const CameraSettings c = readCamera(output_);
    EXPECT_NEAR(0, c.pitch, 3.5 * c.pitchSigma); // 18 sigmas if edges were points
    EXPECT_LT(c.pitchSigma, 0.1);
    EXPECT_NEAR(0, c.roll, 3 * c.rollSigma);
    EXPECT_NEAR(lineDelay, c.lineDelay, 3 * c.lineDelaySigma);
    EXPECT_LT(c.lineDelaySigma, 0.1 * lineDelay);
}

TEST_F(Calibrate, mount_sigma_adds_to_the_vehicles)
{
    addBend(25, 0, 1);
    const std::string camera = contentOf(folder_ / "camera.yml");
    const auto expected = [&](const std::string& file, const Arguments& options) {
        Arguments arguments = {inputs_[0], "--report=-", "--camera=" + (folder_ / file)};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Outcome outcome = correct(arguments);
        EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
        return nlohmann::json::parse(outcome.output)["expected_px_raw"].get<double>();
    };
    // With the vehicle's 1 and 0.3 degrees both are 3 degrees.
    writeContent(folder_ / "vague.yml", camera + cv::format("roll_sigma: %.17g\npitch_sigma: %.17g\n",
                                                            std::sqrt(9 - 1.), std::sqrt(9 - 0.09)));
    const double sharp = expected("camera.yml", {}), vague = expected("vague.yml", {});
    EXPECT_NEAR(expected("camera.yml", {"--gravity_sigma=3"}), vague, 1e-6 * std::abs(vague));
    EXPECT_GT(std::abs(vague - sharp), 1e-3 * std::abs(vague));
    EXPECT_EQ(sharp, expected("vague.yml", {"--roll=0", "--pitch=0"}));
    EXPECT_EQ(expected("camera.yml", {"--gravity_sigma=0.5"}), expected("vague.yml", {"--gravity_sigma=0.5"}));
    writeContent(folder_ / "bad.yml", camera + "roll_sigma: -1.\n");
    const Outcome bad = correct({inputs_[0], "--report=-", "--camera=" + (folder_ / "bad.yml")});
    EXPECT_EQ(2, bad.exitCode);
    EXPECT_NE(std::string::npos, bad.messages.find("roll_sigma (degrees): -1 is not from 0 to 45")) << bad.messages;
}

// A drive that is shown backward is one of a camera that looks back, unless the car is in reverse.
TEST_F(Calibrate, drives_the_other_way)
{
    addBend(0, 0, 8);
    for (const bool isBackward : {false, true})
    {
        for (const char* speed : {"", "36", "-36"})
        {
            log_ = "file,time_s,speed_kmh,speed_sigma_kmh\n";
            for (size_t i = 0; i < inputs_.size(); i++)
                log_ += inputs_[i] + cv::format(",%.6f,%s,%s\n", double(i) * INTERVAL, speed, *speed ? "1" : "");
            const Outcome outcome = run({"--overwrite"});
            const bool isContrary = isBackward != (*speed == '-');
            const char* words = *speed ? "frames the car drives against the speed" : "frames the car drives backward";
            EXPECT_EQ(isContrary, outcome.messages.find(words) != std::string::npos) << speed << outcome.messages;
            EXPECT_EQ(isContrary && *speed ? 1 : 0, outcome.exitCode) << speed;
        }
        std::reverse(inputs_.begin(), inputs_.end());
    }
}

TEST_F(Calibrate, logs_that_the_images_contradict)
{
    addBend(30, 0, 8);
    struct
    {
        double yawRate, speed;
        bool isWrong;
    } const logs[] = {{30, 36, false}, {-30, 36, true}, {60, 36, true}, {30 * DEGREE, 36, true}, {30, 10, true}};
    for (const auto& log : logs)
    {
        SCOPED_TRACE(testing::Message() << log.yawRate << " " << log.speed);
        log_ = "file,time_s,yaw_rate_deg_s,yaw_rate_sigma_deg_s,speed_kmh,speed_sigma_kmh\n";
        for (size_t i = 0; i < inputs_.size(); i++)
            log_ += inputs_[i] + cv::format(",%.6f,%g,0.5,%g,0.5\n", double(i) * INTERVAL, log.yawRate, log.speed);
        const Outcome outcome = run({"--overwrite"});
        EXPECT_EQ(log.isWrong, outcome.messages.find("frames the images contradict") != std::string::npos)
            << outcome.messages;
    }
}

// Seen to the side of where it goes, a car seems to turn otherwise than its log says.
TEST_F(Calibrate, heading_is_no_contradiction)
{
    const std::string drive = folder_ / "drive";
    ASSERT_EQ(0, simulate({"--output=" + drive, "--frames=20", "--heading=7", "--left=6", "--right=8"}).exitCode);
    CameraSettings camera = readCamera(drive + "/camera.yml");
    camera.heading = 0;
    rsackermann_samples::writeCameraFile(folder_ / "straight.yml", camera);
    std::string log = "file,time_s,yaw_rate_deg_s,yaw_rate_sigma_deg_s\n";
    for (const std::string& line : linesOf(drive + "/truth.jsonl"))
    {
        const nlohmann::json truth = nlohmann::json::parse(line);
        log += truth["file"].get<std::string>() +
               cv::format(",%.6f,%.6f,0.3\n", truth["time_s"].get<double>(), truth["yaw_rate_deg_s"].get<double>());
    }
    writeContent(folder_ / "yaw.csv", log);
    const Outcome outcome = calibrate({drive + "/frames", "--camera=" + (folder_ / "straight.yml"),
                                       "--log=" + (folder_ / "yaw.csv"), "--output=" + output_});
    EXPECT_EQ(0, outcome.exitCode);
    EXPECT_EQ("", outcome.messages);
    EXPECT_NEAR(7, readCamera(output_).heading, 0.5) << outcome.output;
}

TEST_F(Calibrate, writes_nothing_that_it_has_not_found)
{
    addBend(20, 0, 3);
    const Outcome outcome = run();
    EXPECT_EQ(1, outcome.exitCode);
    EXPECT_NE(std::string::npos, outcome.output.find("pitch       not observable")) << outcome.output;
    EXPECT_NE(std::string::npos, outcome.messages.find("no file is written")) << outcome.messages;
    EXPECT_FALSE(std::ifstream(output_).good());
}

// An angle of the mount that is neither given nor found is as unknown to those who read the file.
TEST_F(Calibrate, unknown_angles_are_not_level)
{
    writeCamera("camera.yml", 0.8 * LINE_DELAY, false);
    addBend(20, 0, 6);
    const Outcome outcome = run();
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    ASSERT_NE(std::string::npos, outcome.output.find("pitch       not observable")) << outcome.output;
    const CameraSettings c = readCamera(output_);
    EXPECT_TRUE(c.rollIsGiven);
    EXPECT_FALSE(c.pitchIsGiven);
}

TEST_F(Calibrate, repeated_images_are_told)
{
    addBend(20, 0, 6);
    Arguments once = {"--camera=" + (folder_ / "camera.yml"), "--output=" + output_, "--overwrite"}, twice = once;
    for (const std::string& input : inputs_)
    {
        once.push_back(input);
        twice.push_back(input);
        twice.push_back(input);
    }
    EXPECT_EQ(std::string::npos, calibrate(once).messages.find("nearly repeat"));
    EXPECT_NE(std::string::npos, calibrate(twice).messages.find("of 12 images nearly repeat the one before"));
}

TEST_F(Calibrate, bad_arguments)
{
    addBend(10, 0, 2);
    const std::string camera = "--camera=" + (folder_ / "camera.yml"), output = "--output=" + output_;
    const std::pair<Arguments, const char*> usages[] = {
        {{camera, output}, "no input"},
        {{inputs_[0], output}, "--camera is missing"},
        {{inputs_[0], output, camera, "--focal=500"}, "exclude each other"},
        {{inputs_[0], camera}, "--output is missing"},
        {{inputs_[0], camera, output, "--carry"}, "carry"},
        {{inputs_[0], camera, output + ".txt"}, ".txt is none of .yml, .yaml, .xml and .json"},
        {{inputs_[0], camera, output, "--detector=canny"}, "canny"},
        {{inputs_[0], camera, output, "--scan=left_to_right"}, "columns"},
        {{inputs_[0], "--focal=500", output, "--focal_sigma=251"}, "up to half of the focal length, 250 px"},
        {{inputs_[0], camera, output, "--readout=0.3"}, "from 0.002 to 0.1 s for all lines"},
        {{inputs_[0], camera, output, "--log=" + (folder_ / "none.csv")}, "none.csv"},
        {{inputs_[0], camera, output, "--gyro=" + (folder_ / "none.csv")}, "none.csv"},
        {{inputs_[0], camera, output, "--gyro_delay=1"}, "--gyro_delay needs --gyro"},
        {{inputs_[0], camera, "--output=" + (folder_ / "camera.yml"), "--overwrite"}, "camera.yml"},
        {{inputs_[0], camera, "--output=" + inputs_[0], "--overwrite"}, "000.png"}};
    for (const std::pair<Arguments, const char*>& usage : usages)
    {
        const Outcome outcome = calibrate(usage.first);
        EXPECT_EQ(2, outcome.exitCode) << usage.second << outcome.messages;
        EXPECT_NE(std::string::npos, outcome.messages.find(usage.second)) << usage.second << ": " << outcome.messages;
    }
    const std::pair<Arguments, const char*> failures[] = {
        {{inputs_[0], camera, output}, "no frame shows a car that moves"},
        {{inputs_[0], inputs_[0], camera, output}, "images without a time are taken for 1/30 s apart"},
        {{inputs_[0], camera, output, "--log=" + (folder_ / "late.csv")},
         "rsackermann_calibrate: the samples of the log have no effect: all frames are outside of their times, 5000 to "
         "5001 s"},
        {{folder_ / "none.png", camera, output}, "no frame can be read"}};
    writeContent(folder_ / "late.csv", "file,time_s,speed_kmh\n000.png,0,\n,5000,30\n,5001,30\n");
    for (const std::pair<Arguments, const char*>& failure : failures)
    {
        const Outcome outcome = calibrate(failure.first);
        EXPECT_EQ(1, outcome.exitCode) << failure.second;
        EXPECT_NE(std::string::npos, outcome.messages.find(failure.second))
            << failure.second << ": " << outcome.messages;
        EXPECT_FALSE(std::ifstream(output_).good());
    }
    writeContent(output_, "mine");
    EXPECT_EQ(1, calibrate({inputs_[0], camera, output}).exitCode);
    EXPECT_EQ("mine", contentOf(output_));
}

}} // namespace
