// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "fill_unknown.hpp"
#include "opencv2/imgproc.hpp"

namespace cv { namespace rsackermann {

namespace {

// Each level has half of the size of the one before; beyond the last one nothing is known.
const int LEVELS = 7;

// Means over squares of 2 x 2 of the values that aren't NaN; NaN where there is none.
void halve(const Mat1f& fine, Mat1f& coarse)
{
    coarse.create((fine.rows + 1) / 2, (fine.cols + 1) / 2);
    parallel_for_(Range(0, coarse.rows), [&](const Range& rows) {
        for (int y = rows.start; y < rows.end; y++)
            for (int x = 0; x < coarse.cols; x++)
            {
                float sum = 0;
                int count = 0;
                for (int k = 0; k < 4; k++)
                {
                    const int row = 2 * y + k / 2, column = 2 * x + k % 2;
                    const float value = row < fine.rows && column < fine.cols ? fine(row, column) : NAN;
                    if (!cvIsNaN(value))
                    {
                        sum += value;
                        count++;
                    }
                }
                coarse(y, x) = count > 0 ? sum / count : NAN;
            }
    });
}

// The unknown values of a level from the next one, all of whose values are known.
void fillFrom(const Mat1f& coarse, Mat1f& fine)
{
    Mat1f doubled;
    resize(coarse, doubled, Size(2 * coarse.cols, 2 * coarse.rows), 0, 0, INTER_LINEAR);
    parallel_for_(Range(0, fine.rows), [&](const Range& rows) {
        for (int y = rows.start; y < rows.end; y++)
        {
            float* values = fine[y];
            const float* others = doubled[y];
            for (int x = 0; x < fine.cols; x++)
                values[x] = cvIsNaN(values[x]) ? others[x] : values[x];
        }
    });
}

} // namespace

void fillUnknown(const SceneDepth& scene, double scale_, Mat1f& image)
{
    const float scale = float(scale_);
    Mat1f levels[LEVELS], fromScene(image.size());
    levels[0].create(image.size());
    parallel_for_(Range(0, image.rows), [&](const Range& rows) {
        for (int y = rows.start; y < rows.end; y++)
        {
            scene.row(y, fromScene[y]);
            for (int x = 0; x < image.cols; x++)
            {
                fromScene(y, x) *= scale;
                levels[0](y, x) = image(y, x) - fromScene(y, x);
            }
        }
    });
    for (int i = 1; i < LEVELS; i++)
        halve(levels[i - 1], levels[i]);
    patchNaNs(levels[LEVELS - 1], 0);
    for (int i = LEVELS - 1; i > 0; i--)
        fillFrom(levels[i], levels[i - 1]);
    parallel_for_(Range(0, image.rows), [&](const Range& rows) {
        for (int y = rows.start; y < rows.end; y++)
            for (int x = 0; x < image.cols; x++)
                if (cvIsNaN(image(y, x)))
                    image(y, x) = fromScene(y, x) + levels[0](y, x);
    });
}

}} // namespace cv::rsackermann
