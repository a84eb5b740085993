// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Undoes the rolling shutter of a camera or a video while it is seen: the raw and the corrected image side by side,
// with the numbers.

#include "camera_settings.hpp"
#include "correct/video_ends.hpp"
#include "correct/video_timing.hpp"
#include "output/image_file.hpp"
#include "motion_words.hpp"
#include "output/output_plan.hpp"
#include "output/result_names.hpp"
#include "units.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include "opencv2/highgui.hpp"
#include "opencv2/imgcodecs.hpp"
#include "opencv2/imgproc.hpp"
#include "opencv2/rsackermann.hpp"

#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace rsackermann_samples;
using namespace cv::rsackermann;

const char* const ABOUT =
    "Undoes the rolling shutter of a camera or a video while it is seen: the raw and the corrected image side by\n"
    "side, with the numbers.\n"
    "usage: rsackermann_live [--option=value]... INPUT\n"
    "INPUT is a video or the number of a camera. Every key ends the program.\n"
    "Exit code: 0 done, 1 failed, 2 the command line isn't understood.\n";

const char* const KEYS = "{help      |   | print this message}"
                         "{wall      |   | metres to the left wall, or the only one seen; makes the speed metric}"
                         "{frames    | 0 | end after that many frames; 0: go on}"
                         "{picture   |   | image file for the last picture shown, instead of a window}"
                         "{overwrite |   | replace an existing picture}";

// Frames with their times: of a camera those at which they arrive, of a video those that it has.
class Source
{
public:
    explicit Source(const std::string& name)
        : name_(name), isCamera_(name.find_first_not_of("0123456789") == std::string::npos), frames_(0),
          hasEnded_(false)
    {
        if (!isCamera_)
            capture_ = namingFile(name, openVideo);
        else if (!capture_.open(parseInteger(name, "number of the camera", 0, 99)))
            throw InputError("there is no camera " + name);
        if (!isCamera_)
            index_ = readFrameIndex(name);
        clock_.reset(new FrameClock(capture_, index_));
    }

    bool read(cv::Mat& image, double& seconds)
    {
        hasEnded_ = !capture_.grab();
        if (hasEnded_)
            return false;
        seconds = isCamera_ ? double(cv::getTickCount()) / cv::getTickFrequency() : clock_->timeOfFrame(capture_);
        hasEnded_ = !capture_.retrieve(image);
        frames_ += !hasEnded_;
        return !hasEnded_;
    }

    int frames() const { return frames_; }

    //! Throws InputError if a video that has been read to its end is cut short.
    void checkEnd() const
    {
        if (hasEnded_ && !isCamera_)
            namingFile(name_, [&](const std::string& path) {
                rsackermann_samples::checkEnd(path, index_, announcedFrames(index_, capture_), frames_);
            });
    }

private:
    std::string name_;
    bool isCamera_;
    int frames_;
    bool hasEnded_;
    FrameIndex index_{};
    cv::VideoCapture capture_;
    std::unique_ptr<FrameClock> clock_;
};

// Shows pictures in a window, or keeps the last one for a file.
class Screen
{
public:
    explicit Screen(const std::string& path) : path_(path)
    {
        if (path_.empty())
            openWindow();
    }

    // false: it was closed.
    bool show(const cv::Mat& picture)
    {
        const bool isFirst = last_.empty();
        last_ = picture;
        if (!path_.empty())
            return true;
        if (isFirst)
            cv::resizeWindow(NAME, picture.size());
        cv::imshow(NAME, picture);
        return cv::waitKey(1) < 0 && cv::getWindowProperty(NAME, cv::WND_PROP_VISIBLE) > 0;
    }

    void close() const
    {
        if (!path_.empty())
            writeImage(path_, last_);
    }

private:
    // Without a display Qt calls abort(), others throw.
    static void openWindow()
    {
        void (*const before)(int) = std::signal(SIGABRT, [](int) {
            std::fprintf(stderr, "rsackermann_live: %s\n", NO_WINDOW);
            std::_Exit(1);
        });
        try
        {
            cv::namedWindow(NAME, cv::WINDOW_NORMAL | cv::WINDOW_KEEPRATIO);
        }
        catch (const cv::Exception&)
        {
            throw InputError(NO_WINDOW);
        }
        std::signal(SIGABRT, before);
    }

    static const char* const NAME;
    static const char* const NO_WINDOW;
    std::string path_;
    cv::Mat last_;
};

const char* const Screen::NAME = "rsackermann: raw, corrected (a key ends)";
const char* const Screen::NO_WINDOW = "no window can be opened (is there a display?); --picture=FILE needs none";

void write(cv::Mat& picture, int line, const std::string& text)
{
    const double size = picture.rows / 600.;
    const cv::Point place(int(10 * size), int((line + 1) * 24 * size));
    for (const bool isOutline : {true, false})
        cv::putText(picture, text, place, cv::FONT_HERSHEY_SIMPLEX, 0.7 * size, cv::Scalar::all(isOutline ? 0 : 255),
                    cvRound(isOutline ? 4 * size : size) + 1, cv::LINE_AA);
}

void writeNumbers(cv::Mat& picture, const RollingShutterCamera& camera, const AckermannMotion& motion,
                  const cv::Vec4d& milliseconds)
{
    double yawRate = 0, speed = 0;
    std::string numbers = STATUS_WORDS[motion.status];
    if (motion.yawRate(camera, yawRate))
        numbers += cv::format(", %.1f deg/s", yawRate / DEGREE);
    if (motion.speed(camera, speed))
        numbers += cv::format(", %.0f km/h", speed / KMH);
    write(picture, 0, numbers);
    if (motion.status == MOTION_OK || motion.status == MOTION_NOT_SIGNIFICANT)
        write(
            picture, 1,
            cv::format("expected displacement %.2f px, residual %.2f px", motion.expectedRaw, motion.expectedResidual));
    write(picture, 2,
          cv::format("%d of %d verticals, %.0f ms", motion.inliers, motion.candidates, cv::sum(milliseconds)[0]));
}

std::string withoutDigits(std::string text)
{
    text.erase(std::remove_if(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); }), text.end());
    return text;
}

// OpenCV reads a numbered image as a sequence of those whose names differ from it in their digits.
std::vector<std::string> filesRead(const std::string& input)
{
    std::vector<std::string> files(1, input);
    if (!cv::utils::fs::exists(input))
        return files;
    const std::string name = fileName(input), folder = input.substr(0, input.size() - name.size());
    std::vector<cv::String> others;
    cv::utils::fs::glob(folder.empty() ? "." : folder, "*", others, false, false);
    for (const std::string& path : others)
        if (withoutDigits(fileName(path)) == withoutDigits(name))
            files.push_back(path);
    return files;
}

void checkPicture(const Options& options)
{
    const std::string path = options.outputFile("picture");
    if (!cv::haveImageWriter(path))
        throw UsageError("option --picture: " + path + " has the extension of no image format that can be written");
    OutputPlan plan;
    plan.addInputs(filesRead(options.arguments()[0]));
    plan.addInputs(options.inputFiles());
    plan.addOutput(path, "--picture");
    checkResult(path, options.flag("overwrite"));
}

int run(const Options& options)
{
    if (options.arguments().size() != 1)
        throw UsageError("one input is needed");
    const CameraSettings settings = readCameraOptions(options);
    const int frames = options.integer("frames", 0, INT_MAX);
    RollingShutterCorrector::Params params;
    if (options.given("wall"))
        params.estimator.wallDistance = options.positive("wall", 1e5);

    if (options.given("picture"))
        checkPicture(options);

    Source source(options.arguments()[0]);
    Screen screen(options.text("picture"));
    cv::Ptr<RollingShutterCorrector> corrector;
    cv::Mat image, corrected, picture;
    double seconds;
    for (bool goOn = true; goOn && source.read(image, seconds);
         goOn = screen.show(picture) && source.frames() != frames)
    {
        if (!corrector)
        {
            const RollingShutterCamera camera = settings.makeCamera(image.size());
            params.sequence = camera.lineDelay > 0;
            corrector = RollingShutterCorrector::create(camera, params);
        }
        corrector->setTimestamp(seconds);
        const AckermannMotion motion = corrector->correct(image, corrected);
        cv::hconcat(image, corrected, picture);
        writeNumbers(picture, corrector->getCamera(), motion, corrector->getTimings());
    }
    if (source.frames() == 0)
        throw InputError("no frame can be read");
    screen.close();
    source.checkEnd();
    return 0;
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(ABOUT, std::string(KEYS) + CAMERA_KEYS, run, argc, argv);
}
