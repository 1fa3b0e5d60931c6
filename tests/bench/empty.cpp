// An empty program with lobelia's libraries.
int main() {}
