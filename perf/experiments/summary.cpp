// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "summary.hpp"
#include "motion_words.hpp"

#include <cmath>
#include <cstdio>

namespace experiments {

namespace {

void printCase(const Case& c, const Result& r)
{
    std::printf("%s\t%.0f\t%.0f\t%s\t%d\t%d\t%d\t%.3f\t%.3f\t%.2f\t%.2f\t%.2f\t%.2f\t%.1f\t%.3f\n", c.name.c_str(),
                c.scene.speed * 3.6, c.scene.yawRate * 180 / CV_PI, rsackermann_samples::STATUS_WORDS[r.status].c_str(),
                r.model, r.candidates, r.inliers, r.raw, r.left, r.yawRateError, r.yawRateSigma, r.speedError,
                r.speedSigma, r.deltaError, r.floor);
}

// How often the truth lies within two and three of the estimator's standard deviations.
void printCoverage(const char* name, const std::vector<double>& ratios)
{
    int within2 = 0, within3 = 0, known = 0;
    double squares = 0;
    for (double ratio : ratios)
        if (!std::isnan(ratio))
        {
            known++;
            within2 += ratio <= 2;
            within3 += ratio <= 3;
            squares += ratio * ratio;
        }
    if (known)
        std::printf(
            "%-28s truth within 2 sigma in %.1f %%, within 3 sigma in %.1f %% of %d cases, mean of squares %.2f\n",
            name, 100. * within2 / known, 100. * within3 / known, known, squares / known);
}

} // namespace

void printCases(const std::vector<Case>& cases, const std::vector<Result>& results)
{
    std::printf("case\tspeed\tyaw_rate\tstatus\tmodel\tcandidates\tinliers\traw_px\tleft_px\t"
                "yaw_rate_error\tyaw_rate_sigma\tspeed_error\t"
                "speed_sigma\tdelta_error_px\tfloor_px\n");
    for (size_t i = 0; i < cases.size(); i++)
        printCase(cases[i], results[i]);
}

void printSummary(const std::vector<Result>& results)
{
    enum { COLUMNS = 6 };
    std::vector<double> values[COLUMNS], ratios[2];
    int ok = 0, worse = 0;
    for (const Result& r : results)
    {
        const double row[COLUMNS] = {
            r.raw, r.left, std::abs(r.yawRateError), std::abs(r.speedError), std::abs(r.deltaError), r.floor};
        for (int i = 0; i < COLUMNS; i++)
            values[i].push_back(row[i]);
        ratios[0].push_back(std::abs(r.yawRateError) / r.yawRateSigma);
        ratios[1].push_back(std::abs(r.speedError) / r.speedSigma);
        ok += r.status == cv::rsackermann::MOTION_OK;
        worse += r.left > r.raw + 1e-6;
    }
    static const char* const names[] = {"displacement raw, px",      "displacement left, px",
                                        "yaw rate error, deg/s",     "speed error, km/h",
                                        "vanishing point error, px", "predicted by covariance, px"};
    std::printf("\n%d cases, %d with status ok, %d worse than the raw image\n", int(results.size()), ok, worse);
    std::printf("%-28s %8s %8s %8s %8s\n", "", "median", "p90", "mean", "max");
    for (int i = 0; i < COLUMNS; i++)
        if (!std::isnan(mean(values[i])))
            std::printf("%-28s %8.3f %8.3f %8.3f %8.3f\n", names[i], quantile(values[i], 0.5), quantile(values[i], 0.9),
                        mean(values[i]), quantile(values[i], 1));
    printCoverage("yaw rate", ratios[0]);
    printCoverage("speed", ratios[1]);
}

} // namespace experiments
