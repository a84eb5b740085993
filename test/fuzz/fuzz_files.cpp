// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "folder.hpp"
#include "values.hpp"

#include "camera_file.hpp"
#include "drive_log.hpp"
#include "files.hpp"
#include "frames.hpp"
#include "options.hpp"
#include "parsable_text.hpp"
#include "report_file.hpp"
#include "truth_file.hpp"

// Bytes for what reads files. The first byte says which reader it is, the rest is the file.

using namespace cv::rsackermann;
using namespace rsackermann_samples;
using fuzz::require;

namespace {

const char* const FILE_NAME = "file";

void readCalibration()
{
    CameraSettings settings;
    readCameraFile(FILE_NAME, settings);
    const cv::Size size = settings.size.empty() ? cv::Size(640, 480) : settings.size;
    settings.makeCamera(size).check();
}

void readLines()
{
    const cv::Mat segments = readSegments(FILE_NAME);
    require(segments.cols == 4 && segments.type() == CV_32F, "segments aren't rows of four numbers");
    require(fuzz::isFinite(segments), "a segment isn't finite");
}

void readLog()
{
    const DriveLog log(FILE_NAME);
    for (const char* name : {"a.png", "b.mp4", "folder/a.png"})
        for (const double time : {0., 0.5, 1e12})
        {
            const FrameFacts facts = log.of(name, 1, time);
            for (const double value : {facts.time, facts.speed, facts.speedSigma, facts.yawRate, facts.yawRateSigma,
                                       facts.roll, facts.pitch})
                require(!cvIsInf(value), "the log tells of something infinite");
        }
}

void readFramesOfReport()
{
    for (const MotionFrame& frame : readReport(FILE_NAME))
        frame.name();
}

void readFrameOfMotion()
{
    for (const MotionFrame& frame : readMotionFile(FILE_NAME))
        frame.name();
}

void goOnWithReport()
{
    Job job;
    job.inputs.inputs = {{"a.png", 0, 1, ""}, {"b.mp4", 1, 1, ""}};
    job.report = FILE_NAME;
    job.shardCount = 1;
    job.skipExisting = true;
    job.overwrite = false;
    const ReportFile report(job);
    report.has("a.png");
    report.has("b.mp4");
}

template <class Readable>
void readObject(Readable object)
{
    // Not by name: the parser is OpenCV's, and it may not end.
    const cv::FileStorage file(readParsableText(FILE_NAME), cv::FileStorage::READ | cv::FileStorage::MEMORY);
    if (!file.isOpened())
        return;
    object.read(file.root());
    object.check();
}

void readParams()
{
    readObject(AckermannEstimator::Params());
    readObject(WarpMapGenerator::Params());
    readObject(RollingShutterCorrector::Params());
    readObject(MotionPrior());
    readObject(RollingShutterCamera());
}

void readTrueMotion()
{
    readTruth(FILE_NAME);
}

// What the readers promise to throw.
void read(void (*reader)())
{
    try
    {
        reader();
    }
    catch (const UsageError&)
    {
    }
    catch (const InputError&)
    {
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    static const fuzz::Folder folder;
    static void (*const readers[])() = {readCalibration, readLines,      readLog,          readFramesOfReport,
                                        goOnWithReport,  readTrueMotion, readFrameOfMotion};
    if (size == 0 || size > 4096)
        return 0;
    folder.write(FILE_NAME, std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
    const size_t kind = (data[0] - size_t('0')) % 8;
    if (kind < 7)
        read(readers[kind]);
    else
        try
        {
            readParams();
        }
        catch (const std::exception&) // OpenCV's parser throws those of the standard library, too
        {
        }
    return 0;
}
