# The page, from histogram (spheres, directions), tables of rsphere-trade and two.NAME (directions of two points).
function percent(x) { return x == "" ? "" : sprintf(x < .0995 && x > -.0995 ? "%.2f%%" : "%.1f%%", 100 * x) }
function whole(x) { return sprintf("%d%%", 100 * x + .5) }
function minimum(a, b) { return a == "" || b < a ? b : a }
function maximum(a, b) { return a == "" || b > a ? b : a }
function title(what, quality) {
  return (what == "light" ? "Radiance" : "Importance") ", " quality " quality"
}
# Time that equal weights would need for an error: a straight line through what was measured of them, logarithmic.
function fit(key,    i, n, x, y, sx, sy, sxx, sxy) {
  n = rows[key]
  equals = 0
  for (i = 1; i <= n; ++i) {
    if (setting[key, i] !~ /-Sw h/) continue
    x = log(rms[key, i]); y = log(cost[key, i])
    sx += x; sy += y; sxx += x * x; sxy += x * y; ++equals
  }
  slope = (equals * sxy - sx * sy) / (equals * sxx - sx * sx)
  constant = (sy - slope * sx) / equals
}
function equal_time(error) { return exp(constant + slope * log(error)) }

FILENAME ~ /histogram$/ {
  n = $2 - 2048
  sum += n; squares += n * n; ++all; inside += $2 >= 2200 && $2 <= 3500
  if (!($1 in of)) order[++scenes] = $1
  of[$1] += n; ++points[$1]; least[$1] = minimum(least[$1], n); most[$1] = maximum(most[$1], n)
  next
}
FILENAME ~ /two\.[a-z]*$/ { name = FILENAME; sub(/.*two\./, "", name); two[name, FNR] = $1; next }
FNR == 1 { n = split(FILENAME, path, "/"); split(path[n], part, "."); FS = ","; next }
{
  $0 = $0
  key = part[1] SUBSEP part[2] SUBSEP part[3]
  i = ++rows[key]
  setting[key, i] = $1; cost[key, i] = $2; directions[key, i] = $4; rms[key, i] = $5; bias[key, i] = $8
  bias_error[key, i] = $9; says[key, i] = $10; reference[key] = $12
  if ($1 == "-Sw h -Sn 4096 -Sx 4096") equal[key] = i
  if ($1 == "-Sw v -Sn 2048 -Sx 4096") paper[key] = i
  if ($1 == "-Sw c -Sn 2048 -Sx 4096") ours[key] = i
}

END {
  print "# The paper's study again"
  print ""
  print "The results of section 5 of \"A New Technique for Spherical Radiance Calculation\" by Costa, Sousa, Parracho and Cruz, repeated"
  print "on `examples/openplan` with 1 to 100 mirror spheres, with the errors, which they could not measure. Their environment is"
  print "described in words only (a closed open-plan space with furniture, goals on one desktop near the middle, 1 to 100 small"
  print "very reflective spheres near the ceiling); ours follows this description. The purpose of their technique, finding the best"
  print "places for luminaires, is achieved in this room by [rsphere-layout](../layout/README.md#what-a-layout-costs-to-find)."
  print ""
  print "Made by `examples/paper/run FOLDER` in " seconds " s on " date ": " machine ";"
  print version ", " compiler "."
  if (remark) print remark
  print ""
  print "- equal weights: their previous technique, 4096 directions (`-Sw h -Sn 4096`)"
  print "- the paper's: 2048 fixed directions, and up to 2048 to special objects, weighted by plain Voronoi cells"
  print "  (`-Sw v -Sn 2048 -Sx 4096`)"
  print "- ours: cells that end at silhouettes, light sources integrated separately (`-Sw c -Sn 2048 -Sx 4096`, the default)"
  print "- radiance: the luminaires are lit, points are where heads of 12 who sit at desks are; importance: the goal desktop"
  print "  emits (`-Sg goal`), as in the paper, points are 12 under the ceiling"
  print "- low quality: `-ab 1 -ad 1`; high quality: `-ab 5 -ad 1`"
  print ""
  print "Times are CPU seconds of one thread by `rsphere-trade`, errors are root mean squares of relative errors against its"
  print "reference: 36 answers a setting for radiance, 480 for importance, whose errors have a long tail. An error is known to"
  print "about 12%, a ratio of times at equal error to about 35%."
  print ""
  print "## Figure 9: directions to special objects"
  print ""
  print "![histogram](figure9.svg)"
  print ""
  print "| spheres | mean | least | most |"
  print "|---|---|---|---|"
  for (k = 1; k <= scenes; ++k) {
    s = order[k]
    printf "| %d | %.0f | %d | %d |\n", s, of[s] / points[s], least[s], most[s]
  }
  mean = sum / all
  printf "\nIn all %.0f +- %.0f at %d points; theirs is 1030 +- 176 in 3000 iterations, with which numbers of spheres they do not\n", \
    mean, sqrt(squares / all - mean * mean), all
  printf "say. %s of ours have 2200 to 3500 directions in all, as they report; densities were set so that all points of\n", \
    percent(inside / all)
  print "`examples/openplan/points.txt` do."

  print "\n## Figures 10 and 11: time, of that of equal weights\n"
  print "![time ratio](figures10-11.svg)\n"
  print "| | equal weights, ms a point | the paper's, 1 to 100 spheres | ours | the paper says |"
  print "|---|---|---|---|---|"
  split("light.low light.high goal.low goal.high", runs, " ")
  for (r = 1; r <= 4; ++r) {
    split(runs[r], part, ".")
    low_v = high_v = low_c = high_c = low_h = high_h = ""
    for (k = 1; k <= scenes; ++k) {
      key = part[1] SUBSEP part[2] SUBSEP order[k]
      h = cost[key, equal[key]]
      low_h = minimum(low_h, h); high_h = maximum(high_h, h)
      v = cost[key, paper[key]] / h; c = cost[key, ours[key]] / h
      low_v = minimum(low_v, v); high_v = maximum(high_v, v); low_c = minimum(low_c, c); high_c = maximum(high_c, c)
    }
    printf "| %s | %.3g to %.3g | %s to %s | %s to %s | %s |\n", title(part[1], part[2]), 1e3 * low_h, 1e3 * high_h, whole(low_v), \
      whole(high_v), whole(low_c), whole(high_c), part[1] == "light" ? "" : part[2] == "low" ? "68 to 93%" : "65 to 76%"
  }
  print "\nThe paper's ratio follows the number of directions: its cells, which were a good part of the time when the paper was"
  print "written, cost .2 ms a point. Ours takes longer than equal weights, since each of its directions adds a dozen glances"
  print "at diffuse surfaces, and light paths from the sources are traced first, for all 12 points. Times are meaningful only"
  print "together with errors."

  print "\n## Errors, and time at equal error\n"
  print "50 spheres. The last column is the time as a fraction of the time of equal weights for an equal error (a power law through"
  print "their errors with 1024, 4096 and 16384 directions). Bias with its standard error; \"says\" is the error that the setting"
  print "estimates itself (`-oe`)."
  for (r = 1; r <= 4; ++r) {
    split(runs[r], part, ".")
    key = part[1] SUBSEP part[2] SUBSEP 50
    fit(key)
    printf "\n### %s\n\n", title(part[1], part[2])
    printf "![error against time](%s-%s.svg)\n\n", part[1], part[2]
    print "| setting | directions | ms a point | rms error | bias | says | time at equal error |"
    print "|---|---|---|---|---|---|---|"
    for (i = 1; i <= rows[key]; ++i) {
      share = setting[key, i] ~ /-Sw h/ ? "" : whole(cost[key, i] / equal_time(rms[key, i]))
      printf "| `%s` | %.0f | %.3g | %s | %s +- %s | %s | %s |\n", setting[key, i], directions[key, i], 1e3 * cost[key, i], \
        percent(rms[key, i]), percent(bias[key, i]), percent(bias_error[key, i]), percent(says[key, i]), share
      if (setting[key, i] ~ /-Sw c/ && setting[key, i] !~ /-Sk/) {
        if (i == ours[key]) own_share[r] = cost[key, i] / equal_time(rms[key, i])
        low_share[r] = minimum(low_share[r], cost[key, i] / equal_time(rms[key, i]))
        high_share[r] = maximum(high_share[r], cost[key, i] / equal_time(rms[key, i]))
      }
      if (setting[key, i] ~ /-Sw v/) {
        low_paper[r] = minimum(low_paper[r], cost[key, i] / equal_time(rms[key, i]))
        high_paper[r] = maximum(high_paper[r], cost[key, i] / equal_time(rms[key, i]))
      }
    }
    printf "\nStandard error of the reference: %s.\n", percent(reference[key])
  }

  print "\n## Errors with 1 to 100 spheres\n"
  print "High quality. rms errors of equal weights / the paper's / ours, at the numbers of the paper; 16 answers each but for 50"
  print "spheres, so that a figure is known to about 20%.\n"
  print "| spheres | radiance | importance |"
  print "|---|---|---|"
  for (k = 1; k <= scenes; ++k) {
    printf "| %d ", order[k]
    for (w = 1; w <= 2; ++w) {
      key = (w == 1 ? "light" : "goal") SUBSEP "high" SUBSEP order[k]
      printf "| %s / %s / %s ", percent(rms[key, equal[key]]), percent(rms[key, paper[key]]), percent(rms[key, ours[key]])
    }
    print "|"
  }

  for (n = 0; (getline line < beside) > 0; ++n) {
    if (n == 0) {
      print "\n## Beside rsensor\n"
      print "Radiance, 50 spheres, the same 12 points, `-ab 3 -dt 0 -dj 1 -ds .05`; RADIANCE's tool for such integrals, a sensor of even"
      print "response, with so many rays (`-rd`). Errors are what 8 repeats with other directions differ by (`tests/bench/rtrace/means`).\n"
      print "| | ms a point | rms error |"
      print "|---|---|---|"
    }
    match(line, / +[0-9.]+ ms a point/)
    name = substr(line, 1, RSTART - 1)
    split(substr(line, RSTART), field, " ")
    sub(/ /, " `", name)
    printf "| %s` | %.3g | %s |\n", name, field[1], field[6]
  }

  print "\n## Figures 12 to 15: what two points see\n"
  print "Importance (`-Sg goal -ab 2 -ad 512`, 50 spheres), from zenith to nadir over all azimuths, each pixel with the value of"
  print "the nearest direction. The colors are logarithmic: white is the brightest, black 1/10,000 of it or less.\n"
  print "| | point 1 | point 2 |"
  print "|---|---|---|"
  split("previous new ours", names, " ")
  split("equal weights;the paper's;ours", words, ";")
  for (i = 1; i <= 3; ++i)
    printf "| %s: %d and %d directions | ![](point0-%s.png) | ![](point1-%s.png) |\n", words[i], two[names[i], 1], \
      two[names[i], 2], names[i], names[i]

  print "\n## Where the technique helps, and where it does not\n"
  printf "- The paper's technique takes less time than equal weights because it sends fewer directions. At equal error it takes\n"
  printf "  %s to %s of their time for radiance (low quality), %s to %s (high); for importance %s to %s and %s to %s. So\n", \
    whole(low_paper[1]), whole(high_paper[1]), whole(low_paper[2]), whole(high_paper[2]), whole(low_paper[3]), \
    whole(high_paper[3]), whole(low_paper[4]), whole(high_paper[4])
  print "  it does not help here: the error is due to sources (or the goal) seen directly, for which it has half as many"
  print "  directions, not to reflections in 50 spheres of 10 cm. Its plain cells also extend across the edges of silhouettes."
  printf "- Ours takes, at the paper's numbers of directions, %s (low quality) and %s (high) of the time of equal weights at\n", \
    whole(own_share[1]), whole(own_share[2])
  printf "  equal error for radiance, %s and %s for importance.\n", whole(own_share[3]), whole(own_share[4])
  printf "- With other numbers of directions it is %s to %s (low) and %s to %s (high) for radiance.\n", \
    whole(low_share[1]), whole(high_share[1]), whole(low_share[2]), whole(high_share[2])
  print "  The reason is the separate integration of light sources, more than directions to special objects."
  printf "- For importance it is then %s to %s (low) and %s to %s (high). The goal is one desktop: it is integrated separately where it\n", \
    whole(low_share[3]), whole(high_share[3]), whole(low_share[4]), whole(high_share[4])
  print "  is seen, and light paths from it bring the light that arrives by other surfaces."
  print "- Rows with `-Sk 0` are without directions to special objects, and without glances and light paths. For radiance with one"
  print "  bounce they take about the same time at equal error, for importance longer."
  print "  tests/bench/README.md has two rooms where directions to special objects count."
}
