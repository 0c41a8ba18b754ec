import java.io.BufferedReader;
import java.io.InputStreamReader;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.IntStream;

/** Right for the exam of flat colours, with a parallel stream over the rows of the picture. */
public class Tracer {
    static double number(String text, String key) {
        Matcher found = Pattern.compile("\"" + key + "\":\\s*([^,}]*)").matcher(text);
        return found.find() ? Double.parseDouble(found.group(1).trim()) : 0;
    }

    static void render(Path scene, Path out) throws Exception {
        String text = Files.readString(scene);
        int width = (int) number(text, "width");
        int height = (int) number(text, "height");
        Matcher light = Pattern.compile("\"background\":\\s*\\[([^,]*),([^,]*),([^\\]]*)\\]").matcher(text);
        light.find();
        byte[] header = ("PF\n" + width + " " + height + "\n-1.0\n").getBytes(StandardCharsets.US_ASCII);
        ByteBuffer picture = ByteBuffer.allocate(header.length + 12 * width * height);
        picture.order(ByteOrder.LITTLE_ENDIAN).put(header);
        IntStream.range(0, height).parallel().forEach(row -> {
            for (int i = 0; i < 3 * width; i++) {
                int at = header.length + 4 * (3 * width * row + i);
                picture.putFloat(at, Float.parseFloat(light.group(1 + i % 3).trim()));
            }
        });
        Files.write(out, picture.array());
    }

    static void probe() throws Exception {
        BufferedReader lines = new BufferedReader(new InputStreamReader(System.in));
        for (String line = lines.readLine(); line != null; line = lines.readLine()) {
            Matcher id = Pattern.compile("\"id\":\"([^\"]*)\"").matcher(line);
            id.find();
            double r = number(line, "r");
            double sum = number(line, "quadratic") * r * r + number(line, "linear") * r + number(line, "constant");
            System.out.println("{\"id\":\"" + id.group(1) + "\",\"value\":" + 1 / Math.max(sum, 1) + "}");
        }
    }

    public static void main(String[] words) throws Exception {
        if (words.length > 2) {
            render(Path.of(words[1]), Path.of(words[2]));
        } else {
            probe();
        }
    }
}
