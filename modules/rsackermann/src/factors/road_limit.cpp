// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "road_limit.hpp"
#include "robust_losses.hpp"

namespace cv { namespace rsackermann {

// Of the table of likelihoods, in steps of HEIGHT_SIGMA around a distance of one height: 0.01 to 100 heights.
enum { BINS = 160 };

static double binOf(double logRatio)
{
    const int middle = BINS / 2;
    return middle + logRatio / HEIGHT_SIGMA;
}

static const double farthest = 4; // sigmas

// Of an end that is by z sigmas farther away than the foot of its wall.
static double probabilityAbove(double z)
{
    return z < farthest ? UNUSUAL + (1 - UNUSUAL) * 0.5 * std::erfc(-z / std::sqrt(2.)) : 1;
}

void RoadLimit::add(bool onRightWall, double ratio, double weight)
{
    const double logRatio = std::log(ratio), part = weight / DEPENDENCE;
    if (!(std::abs(logRatio) < DBL_MAX))
        return;
    Table& table = walls[onRightWall];
    table.values.resize(BINS, 1);
    table.ends.push_back({logRatio, part});
    for (int i = 0; i < BINS; i++)
    {
        const double z = binOf(logRatio) - i;
        if (z < farthest)
            table.values[i] *= std::pow(probabilityAbove(z), part);
    }
}

// A share of the ends, any with the same probability, is at one ratio, the others are anywhere. What is at one is the
// foot of the wall, or something else.
void RoadLimit::Table::addContacts()
{
    const int shares = 8, size = shares * BINS;
    std::vector<double> logFoot(size), logOther(size);
    for (int k = 0; k < size; k++)
    {
        const int index = k / BINS;
        const double share = (index + 0.5) / shares, density = share / (1 - share) * BINS / std::sqrt(2 * CV_PI);
        for (const End& end : ends)
        {
            const double z = binOf(end.logRatio) - k % BINS, notThere = end.part * std::log(1 - share);
            const double there = std::abs(z) < farthest ? density * std::exp(-z * z / 2) : 0;
            logFoot[k] += notThere + (there > 0 ? end.part * std::log1p(there / probabilityAbove(z)) : 0);
            logOther[k] += notThere + (there > 0 ? end.part * std::log1p(there) : 0);
        }
    }
    const double largest = *std::max_element(logFoot.begin(), logFoot.end());
    std::vector<double> foot(BINS);
    double other = 0;
    for (int k = 0; k < size; k++)
    {
        foot[k % BINS] += std::exp(logFoot[k] - largest);
        other += std::exp(logOther[k] - largest) / BINS;
    }
    for (int i = 0; i < BINS; i++)
        values[i] *= (1 - UNUSUAL) * foot[i] + UNUSUAL * other;
}

void RoadLimit::addContacts()
{
    for (Table& table : walls)
        if (!table.values.empty())
            table.addContacts();
}

double RoadLimit::Table::at(double logRatio) const
{
    if (values.empty())
        return 1;
    const double place = std::min(std::max(binOf(logRatio), 0.), BINS - 1.001);
    const int i = int(place);
    return values[i] + (place - i) * (values[i + 1] - values[i]);
}

}} // namespace cv::rsackermann
