// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "frame_corrector.hpp"
#include "map_distance.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include "opencv2/imgproc.hpp"

namespace rsackermann_samples {

using namespace cv::rsackermann;

namespace {

// The 8-bit colour picture of an image, to draw upon.
cv::Mat pictureOf(const cv::Mat& image)
{
    cv::Mat picture;
    if (image.depth() == CV_16U)
        image.convertTo(picture, CV_8U, 1 / 257.);
    else
        picture = image.clone();
    if (picture.channels() == 1)
        cv::cvtColor(picture, picture, cv::COLOR_GRAY2BGR);
    else if (picture.channels() == 4)
        cv::cvtColor(picture, picture, cv::COLOR_BGRA2BGR);
    return picture;
}

bool isSame(const cv::Mat& a, const cv::Mat& b)
{
    return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

} // namespace

bool FrameCorrector::isDone(const std::string& input) const
{
    if (!job_.skipExisting)
        return false;
    // The output is written last: where it exists everything does.
    return cv::utils::fs::exists(job_.output.empty() ? resultPath(job_.overlay, job_.overlayIsFolder, input)
                                                     : resultPath(job_.output, job_.outputIsFolder, input));
}

void FrameCorrector::checkTargets(const std::string& input) const
{
    const std::string output = resultPath(job_.output, job_.outputIsFolder, input);
    const std::string overlay = resultPath(job_.overlay, job_.overlayIsFolder, input);
    for (const std::string& path : {output, overlay, job_.maps})
    {
        if (path.empty())
            continue;
        if (isSameFile(path, input))
            throw InputError("the result " + path + " would replace the input");
        if (cv::utils::fs::isDirectory(path))
            throw InputError(path + " is a folder");
        if (!job_.overwrite && !job_.skipExisting && cv::utils::fs::exists(path))
            throw InputError(path + " exists (--overwrite replaces it)");
    }
}

void FrameCorrector::prepare(const cv::Size& size)
{
    if (corrector_ && camera_.imageSize == size)
        return;
    camera_ = job_.camera.makeCamera(size);
    corrector_ = RollingShutterCorrector::create(camera_, job_.params);
    WarpMapGenerator::create(camera_, job_.params.warp)->initRectifyMap(AckermannMotion(), lensMap1_, lensMap2_);
}

FrameReport FrameCorrector::process(const std::string& input)
{
    checkTargets(input);
    const cv::Mat image = readImage(input);
    prepare(image.size());

    cv::Mat corrected, mask, segments, labels, map1, map2;
    FrameReport report;
    report.input = input;
    report.camera = camera_;
    report.motion = job_.linesGiven ? corrector_->correctWithSegments(image, job_.lines, corrected, mask)
                                    : corrector_->correct(image, corrected, mask);
    corrector_->getSegments(segments, labels);
    corrector_->getMaps(map1, map2);
    report.segments = segments.rows;
    // Without a motion the maps undo the lens only.
    report.meanShift = report.motion.status == MOTION_OK ? meanDistance(map1, map2, lensMap1_, lensMap2_, mask) : 0;
    report.timings = corrector_->getTimings();

    if (!job_.overlay.empty())
    {
        cv::Mat picture = pictureOf(image);
        drawMotion(picture, segments, labels, camera_, report.motion);
        writeImage(resultPath(job_.overlay, job_.overlayIsFolder, input), picture);
    }
    if (!job_.maps.empty())
        writeMaps(job_.maps, map1, map2);
    if (!job_.output.empty())
    {
        const std::string path = resultPath(job_.output, job_.outputIsFolder, input);
        // An image that stays as it is doesn't lose anything by being coded again.
        if (extension(path) == extension(input) && isSame(image, corrected))
            copyFile(input, path);
        else
            writeImage(path, corrected);
    }
    return report;
}

void FrameCorrector::writeMaps(const std::string& path, const cv::Mat& map1, const cv::Mat& map2) const
{
    AtomicFile file(path);
    cv::FileStorage fs(file.temporaryName(), cv::FileStorage::WRITE);
    if (!fs.isOpened())
        throw InputError(path + " can't be written");
    fs << "map1" << map1 << "map2" << map2;
    fs.release();
    file.commit();
}

} // namespace rsackermann_samples
