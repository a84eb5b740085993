// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "opencv2/imgproc.hpp"
#include "../checks.hpp"
#include "../parallel_loop.hpp"
#include "detectors.hpp"
#include "edges.hpp"
#include "segment_finder.hpp"
#include <numeric>

namespace cv { namespace rsackermann {

// The scale of LSD: its own one. If the ends are refined afterwards, an image of that many pixels suffices.
static double lsdScale(const Mat& image, bool isRefined)
{
    const double own = 0.8, enoughPixels = 200000;
    return isRefined ? std::min(own, std::sqrt(enoughPixels / image.total())) : own;
}

void checkDetector(int detector, const char* name)
{
    REJECT_IF(
        detector < DETECTOR_LSD || detector > DETECTOR_VERTICALS,
        "%s is %d; DETECTOR_LSD (0), DETECTOR_FLD (1), DETECTOR_EDLINES (2) or DETECTOR_VERTICALS (3) is expected",
        name, detector);
}

static void checkArguments(InputArray image, int detector, double minLength)
{
    checkImage(image, "image");
    checkDetector(detector, "detector");
    REJECT_IF(!(minLength >= 0) || cvIsInf(minLength),
              "minLength is %g; a number of pixels that isn't negative is expected", minLength);
}

static double lengthOf(const Vec4f& s)
{
    return std::hypot(s[2] - s[0], s[3] - s[1]);
}

// How often each value occurs in a 16-bit image; in a large one only as many rows are looked at as it takes.
static std::vector<int> histogramOf(const Mat& gray)
{
    const size_t enoughPixels = 200000;
    const int rowStep = std::max(int(std::min(gray.total() / enoughPixels, size_t(gray.rows / MIN_DETECTOR_SIZE))), 1);
    std::vector<int> counts(USHRT_MAX + 1);
    for (int y = 0; y < gray.rows; y += rowStep)
    {
        const ushort* row = gray.ptr<ushort>(y);
        for (int x = 0; x < gray.cols; x++)
            counts[row[x]]++;
    }
    return counts;
}

// The range of the values without a share, less than one half, of the darkest and of the brightest pixels.
static Range rangeWithout(double share, const std::vector<int>& counts)
{
    const double pixels = share * std::accumulate(counts.begin(), counts.end(), 0.);
    Range range(0, USHRT_MAX);
    for (double n = counts[range.start]; n <= pixels; n += counts[range.start])
        range.start++;
    for (double n = counts[range.end]; n <= pixels; n += counts[range.end])
        range.end--;
    return range;
}

// 16-bit images seldom use their whole range: the range of the data becomes 0..255. So that a lamp or a defective pixel
// takes no contrast from the rest, the darkest and the brightest hundredth of the pixels don't count. A tenth more on
// either side keeps what goes only a little beyond, as where the slope of an edge is cut the edge is displaced.
static void to8Bit(const Mat& gray, Mat& scaled)
{
    const std::vector<int> counts = histogramOf(gray);
    Range range = rangeWithout(0.01, counts);
    if (range.start >= range.end) // all but a few pixels are the same: what there is to see are the few
        range = rangeWithout(0, counts);
    const double margin = 0.1 * (range.end - range.start);
    const double low = range.start - margin, high = range.end + margin;
    const double scale = high > low ? 255 / (high - low) : 0;
    gray.convertTo(scaled, CV_8U, scale, -low * scale);
}

const Mat& SegmentFinder::toGray(const Mat& image)
{
    Mat& converted = image.depth() == CV_8U ? gray8U : gray16U;
    if (image.channels() > 1)
        cvtColor(image, converted, image.channels() == 3 ? COLOR_BGR2GRAY : COLOR_BGRA2GRAY);
    if (image.depth() != CV_8U)
        to8Bit(image.channels() > 1 ? converted : image, gray8U);
    return image.type() == CV_8UC1 ? image : gray8U;
}

const Mat& SegmentFinder::shrink(const Mat& image)
{
    const Mat* last = &image;
    scale = 1;
    for (int i = 0; last->total() > MAX_PIXELS && std::min(last->rows, last->cols) >= 2 * MIN_DETECTOR_SIZE;
         i = 1 - i, scale *= 2)
    {
        // An odd last row or column is left out.
        const Rect even(0, 0, last->cols / 2 * 2, last->rows / 2 * 2);
        resize((*last)(even), half[i], Size(last->cols / 2, last->rows / 2), 0, 0, INTER_AREA);
        last = &half[i];
    }
    return *last;
}

void SegmentFinder::prepare(InputArray image_)
{
    const Mat image = image_.getMat();
    gray = toGray(image);
    small = shrink(gray);
}

void SegmentFinder::findInStrips(const Mat& image, int count, int detector, double minLength, double detectorScale)
{
    strips.resize(count);
    foundInStrips.resize(count);
    std::vector<Range> own(count), seen(count);
    for (int i = 0; i < count; i++)
    {
        own[i] = Range(int(int64(image.cols) * i / count), int(int64(image.cols) * (i + 1) / count));
        seen[i] = Range(std::max(own[i].start - OVERLAP, 0), std::min(own[i].end + OVERLAP, image.cols));
        // A copy: not all of the detectors leave their input alone or take parts of larger images.
        image.colRange(seen[i]).copyTo(strips[i]);
    }
    forEachInParallel(count, [&](int i) {
        foundInStrips[i].clear();
        if (detector == DETECTOR_LSD)
            detectLSD(strips[i], detectorScale, foundInStrips[i]);
        else if (detector == DETECTOR_FLD)
            detectFLD(strips[i], minLength, foundInStrips[i]);
        else
            detectEDLines(strips[i], minLength, foundInStrips[i]);
    });
    found.clear();
    for (int i = 0; i < count; i++)
        for (size_t k = 0; k < foundInStrips[i].size(); k++)
        {
            const Vec4f s = foundInStrips[i][k] + Vec4f(float(seen[i].start), 0, float(seen[i].start), 0);
            // In the overlap a segment is found twice and taken from the strip that has its middle.
            const float middle = (s[0] + s[2]) / 2;
            if ((i == 0 || middle >= own[i].start) && (i == count - 1 || middle < own[i].end))
                found.push_back(s);
        }
}

// Drops shorter ones.
void SegmentFinder::keepLong(double minLength)
{
    size_t kept = 0;
    for (size_t i = 0; i < found.size(); i++)
        if (lengthOf(found[i]) >= minLength)
            found[kept++] = found[i];
    found.resize(kept);
}

void SegmentFinder::findAndRefine(int detector, double minLength)
{
    const bool isRefined = scale > 1 || detector != DETECTOR_LSD;
    const int stripCount = isRefined ? std::max(cvRound(small.cols / double(STRIP_WIDTH)), 1) : 1;
    findInStrips(small, stripCount, detector, minLength / scale, lsdScale(small, isRefined));
    const float shift = (scale - 1) / 2.f; // centre of the first pixel of the small image
    for (size_t i = 0; i < found.size(); i++)
        found[i] = found[i] * float(scale) + Vec4f::all(shift);
    if (isRefined || isForMany)
    {
        // Ends that move across a segment hardly make it longer.
        keepLong(0.9 * minLength);
        moveToEdges(gray, isForMany ? END_FOR_MANY : 0, found);
    }
}

void SegmentFinder::find(InputArray image_, int detector, double minLength, OutputArray segments_)
{
    checkArguments(image_, detector, minLength);
    const Mat image = image_.getMat();
    minLength = std::min(minLength, double(image.rows) + image.cols); // no segment is as long
    found.clear();
    prepare(image);
    if (image.rows >= MIN_DETECTOR_SIZE && image.cols >= MIN_DETECTOR_SIZE)
    {
        if (detector == DETECTOR_VERTICALS)
            detectVerticals(gray, small, scale, minLength, isForMany, found);
        else
            findAndRefine(detector, minLength);
    }
    keepLong(minLength);
    returnSegments(found.empty() ? Mat(0, 4, CV_32F) : Mat(found).reshape(1, (int)found.size()), segments_);
}

void detectSegments(InputArray image, OutputArray segments, int detector, double minLength)
{
    CV_INSTRUMENT_REGION();
    SegmentFinder().find(image, detector, minLength, segments);
}

}} // namespace cv::rsackermann
