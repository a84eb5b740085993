// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "opencv2/imgproc.hpp"
#include "detectors.hpp"

namespace cv {
namespace rsackermann {

static Mat toGray(const Mat& image)
{
    Mat gray;
    if (image.channels() == 1)
        return image;
    cvtColor(image, gray, image.channels() == 3 ? COLOR_BGR2GRAY : COLOR_BGRA2GRAY);
    return gray;
}

// 16-bit images seldom use their whole range: the range of the data becomes 0..255.
static Mat to8Bit(const Mat& gray)
{
    if (gray.depth() == CV_8U)
        return gray;
    double low, high;
    minMaxLoc(gray, &low, &high);
    const double scale = high > low ? 255 / (high - low) : 0;
    Mat scaled;
    gray.convertTo(scaled, CV_8U, scale, -low * scale);
    return scaled;
}

void detectSegments(InputArray image_, OutputArray segments_, int detector, double minLength)
{
    CV_INSTRUMENT_REGION();

    const Mat image = image_.getMat();
    const int channels = image.channels();
    if (image.empty() || image.dims > 2)
        CV_Error(Error::StsBadArg, "image is empty; a grey or colour image is expected");
    if ((image.depth() != CV_8U && image.depth() != CV_16U) || (channels != 1 && channels != 3 && channels != 4))
        CV_Error(Error::StsBadArg, format("image is of type %s; CV_8U or CV_16U with 1, 3 or 4 channels is expected",
                                          typeToString(image.type()).c_str()));
    if (detector < DETECTOR_LSD || detector > DETECTOR_EDLINES)
        CV_Error(Error::StsBadArg, format("detector is %d; DETECTOR_LSD (0), DETECTOR_FLD (1) or DETECTOR_EDLINES (2) is expected", detector));
    if (!(minLength >= 0) || cvIsInf(minLength))
        CV_Error(Error::StsBadArg, format("minLength is %g; a number of pixels that isn't negative is expected", minLength));

    std::vector<Vec4f> found;
    if (image.rows >= MIN_DETECTOR_SIZE && image.cols >= MIN_DETECTOR_SIZE)
    {
        Mat gray = to8Bit(toGray(image));
        if (gray.data == image.data)
            gray = gray.clone(); // not all of the detectors leave their input alone or take parts of larger images
        if (detector == DETECTOR_LSD)
            detectLSD(gray, found);
        else if (detector == DETECTOR_FLD)
            detectFLD(gray, minLength, found);
        else
            detectEDLines(gray, minLength, found);
    }

    std::vector<Vec4f> kept;
    for (size_t i = 0; i < found.size(); i++)
        if (std::hypot(found[i][2] - found[i][0], found[i][3] - found[i][1]) >= minLength)
            kept.push_back(found[i]);
    segments_.create(int(kept.size()), 4, CV_32F);
    if (!kept.empty())
        Mat(kept).reshape(1).copyTo(segments_);
}

}} // namespace cv::rsackermann
