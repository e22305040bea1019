# Figures 9, 10 and 11 as SVG, from histogram (spheres, directions) and tables of rsphere-trade, to the folder `out`.
function begin_plot(title, low_x, high_x, low_y, high_y, label_x, label_y) {
  labels = ""
  x0 = low_x; x1 = high_x; y0 = low_y; y1 = high_y
  svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 640 360\" font-family=\"sans-serif\" font-size=\"12\">\n" \
    "<rect width=\"640\" height=\"360\" fill=\"white\"/>\n" text(60, 22, title, "start") text(340, 350, label_x, "middle") \
    "<text transform=\"translate(12 180) rotate(-90)\" text-anchor=\"middle\">" label_y "</text>\n"
}
function px(x) { return 60 + 560 * (x - x0) / (x1 - x0) }
function py(y) { return 315 - 275 * (y - y0) / (y1 - y0) }
function text(x, y, words, anchor) {
  return sprintf("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" stroke=\"white\" stroke-width=\"3\" " \
                 "stroke-linejoin=\"round\" paint-order=\"stroke\">%s</text>\n", x, y, anchor, words)
}
function tick_x(x, words) { svg = svg text(px(x), 331, words, "middle") }
function tick_y(y, words) {
  svg = svg sprintf("<path d=\"M60 %.1fH620\" stroke=\"#ddd\"/>\n", py(y)) text(54, py(y) + 4, words, "end")
}
function band(low, high, color, words, x, y, anchor) {
  svg = svg sprintf("<rect x=\"60\" y=\"%.1f\" width=\"560\" height=\"%.1f\" fill=\"%s\" opacity=\".25\"/>\n", py(high),
                    py(low) - py(high), color)
  labels = labels text(x, y, words, anchor)
}
function end_plot(name) { print svg labels "</svg>" > (out "/" name) }

FILENAME ~ /histogram$/ {
  bin = int(($2 - 2048) / 100)
  ++bins[bin]; ++all
  if (bin > last) last = bin
  next
}
FNR == 1 { n = split(FILENAME, path, "/"); split(path[n], part, "."); FS = ","; next }
{
  $0 = $0
  what = part[1]; quality = part[2]; spheres = part[3]
  if (/-Sw h -Sn 4096/) equal[what, quality, spheres] = $2
  if (/-Sw v -Sn 2048/) paper[what, quality, spheres] = $2
}

END {
  begin_plot("Directions to special objects, -Sw v (" all " points)", 0, 100 * (last + 1), 0, .35,
             "directions besides the 2048 fixed ones", "share of points")
  for (y = 0; y < .36; y += .1) tick_y(y, sprintf("%d%%", 100 * y + .5))
  for (bin = 0; bin <= last; ++bin) {
    share = bins[bin] / all
    svg = svg sprintf("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"#1b6fb3\"/>\n", px(100 * bin) + 1,
                      py(share), px(100) - px(0) - 2, py(0) - py(share))
    if (bin % 2 == 0) tick_x(100 * bin, 100 * bin)
  }
  svg = svg sprintf("<path d=\"M%.1f 50H%.1fM%.1f 45v10\" stroke=\"#d95f02\" stroke-width=\"2\"/>\n", px(854), px(1206), px(1030)) \
    text(px(1030), 68, "the paper: 1030 +- 176", "middle") \
    text(620, 22, "at most 2048, in the last bar", "end")
  end_plot("figure9.svg")

  begin_plot("Time of the paper's technique, relative to that of equal weights", 0, 100, .4, 1.5, "spheres", "share of time")
  band(.68, .93, "#d95f02", "the paper, low quality: 68 to 93%", 64, py(.93) - 4, "start")
  band(.65, .76, "#1b6fb3", "the paper, high quality: 65 to 76%", 616, py(.65) + 13, "end")
  for (y = .4; y < 1.51; y += .1) tick_y(y, sprintf("%d%%", 100 * y + .5))
  for (x = 0; x <= 100; x += 25) tick_x(x, x)
  svg = svg "<rect x=\"66\" y=\"28\" width=\"200\" height=\"70\" fill=\"white\"/>\n"
  split("1 10 25 50 100", counts, " ")
  row = 92
  split("light.low light.high goal.low goal.high", runs, " ")
  split("radiance, low quality;radiance, high quality;importance, low quality;importance, high quality", names, ";")
  split("#d95f02 #1b6fb3 #d95f02 #1b6fb3", colors, " ")
  for (i = 4; i >= 1; --i) {
    split(runs[i], part, ".")
    line = ""
    for (k = 1; k <= 5; ++k) {
      key = part[1] SUBSEP part[2] SUBSEP counts[k]
      line = line sprintf("%s%.1f %.1f", line == "" ? "M" : "L", px(counts[k]), py(paper[key] / equal[key]))
    }
    dash = i > 2 ? " stroke-dasharray=\"5 4\"" : ""
    svg = svg "<path d=\"" line "\" fill=\"none\" stroke-width=\"2\" stroke=\"" colors[i] "\"" dash "/>\n" \
      sprintf("<path d=\"M70 %dh30\" stroke-width=\"2\" stroke=\"%s\"%s/>\n", row - 4, colors[i], dash) text(106, row, names[i], "start")
    row -= 16
  }
  end_plot("figures10-11.svg")
}
