"""Where luminaires should hang: the layout that meets goals with the least watts. The command rsphere-layout does all of it."""
