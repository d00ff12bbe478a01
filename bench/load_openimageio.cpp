// Does nothing: running it takes the time that OpenImageIO's libraries take to load.
int main() { return 0; }
